// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../pipeline/stage.h"

#include <pcl6d/slam6d/slam_stage.h>

#include <memory>

/** \file The stages of a run, each defined in a file of its name. */
namespace pcl6d::slam6d {

using StagePtr = std::unique_ptr<Stage>;

/** Range gate, reduction and normals of the waiting scans; parameters from the first scans. */
StagePtr
prepareScans();

/** Book 4.1.5, 5.1.1: each scan is matched with the map of the scans before. */
StagePtr
registerScans();

/** Lost scans are recovered with the help of all scans. */
StagePtr
recoverLost();

/** Book 5.1: loops are closed, then the poses of all scans are relaxed together. */
StagePtr
relaxGraph();

/** Scans without poses are joined by common surfaces, in any order, and relaxed. */
StagePtr
joinAnyOrder();

/** Scans without poses: in their order first, then in any order; the better start is kept.
 * \param[in] in_order, any_order the stages of each */
StagePtr
findStart(StageList in_order, StageList any_order);

/** The motions within all scans, estimated together. */
StagePtr
relaxMotion();

/** Dynamic points are found, and take no part in another round of relaxation. */
StagePtr
leaveOutMoving();

/** Scans of 2D scanners stay in their plane. */
StagePtr
keepInPlane();

/** The verdict on the map. */
StagePtr
verifyMap();

/** Scans contradicted by the verdict are disconnected and registered again. The result is kept if
 * more scans are connected; it is neither relaxed nor completely verified if it cannot be.
 * \param[in] recovering, relaxing stages of the new registration */
StagePtr
lookAgain(StageList recovering, StageList relaxing);

/** Scans that a search found after matching had failed, and that the verdict connects with no
 * others, return to where the given poses lead: one wrong place would take the lost scans behind
 * it along. */
StagePtr
returnUnconfirmed();

/** Lost scans that match each other are registered with each other, as far as links confirm their
 * matches. Each part follows the odometry from the scan before, beside the map: floating. */
StagePtr
registerPieces();

/** The map is adjusted to its refined links, which know the poses of sparse scans better than matching
 * does; kept if the verdict stays and as many scans are connected. */
StagePtr
adjustToLinks();

/** Writes the results on dynamic points and on motion within scans, at the final poses. */
StagePtr
describeMotion();

/** The map is adjusted to control points, if given. */
StagePtr
adjustToControl();

/** A stage of the user. */
StagePtr
userStage(std::shared_ptr<SlamStage> stage, SlamStage::Place place);

/** \return whether more than a quarter of the scans match neither the map nor the scan before; false
 * unless the order is a trial */
bool
isOrderHopeless(const SlamState& state);

} // namespace pcl6d::slam6d
