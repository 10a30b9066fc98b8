// SPDX-License-Identifier: BSD-3-Clause
#include "../packing.h"
#include "../stages/stages.h"
#include "pipeline.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace pcl6d::slam6d {

namespace {
template <typename... Stages>
StageList
listOf(Stages... stages)
{
  StageList list;
  (list.push_back(std::move(stages)), ...);
  return list;
}

/** Appends the user's stages for a position to a list. */
void
append(const AddedStages& added, SlamStage::Place place, StageList& list)
{
  for (const auto& [stage, wanted] : added)
    if (wanted == place)
      list.push_back(userStage(stage, place));
}

/** For scans with predicted poses, by odometry or by their order. */
StageList
stagesInOrder(const AddedStages& added)
{
  StageList list = listOf(registerScans(), recoverLost());
  append(added, SlamStage::Place::kAfterMatching, list);
  list.push_back(relaxGraph());
  return list;
}
} // namespace

StageList
stagesOfRun(const AddedStages& added)
{
  StageList list = listOf(prepareScans());
  for (auto& stage : stagesInOrder(added)) // with poses
    list.push_back(std::move(stage));
  list.push_back(findStart(stagesInOrder(added), listOf(joinAnyOrder()))); // without
  list.push_back(relaxMotion());
  list.push_back(leaveOutMoving());
  append(added, SlamStage::Place::kAfterRelaxation, list);
  list.push_back(keepInPlane());
  list.push_back(verifyMap());
  list.push_back(lookAgain(listOf(recoverLost()), listOf(relaxGraph())));
  list.push_back(returnUnconfirmed());
  list.push_back(registerPieces());
  list.push_back(adjustToLinks());
  list.push_back(describeMotion());
  list.push_back(adjustToControl());
  return list;
}

namespace {
/** The other processes take over the value of the first. */
template <typename Value>
Value
ofFirst(Value value, const SlamContext& context)
{
  return context.sharing ? context.sharing->fromFirst(value) : value;
}

void
takeResultOfFirst(SlamState& state, const SlamContext& context)
{
  if (!context.sharing)
    return;
  state.next = ofFirst(state.next, context);
  state.breaks = ofFirst(state.breaks, context);
  state.pieces = ofFirst(state.pieces, context);
  state.beside = ofFirst(state.beside, context);
  state.recovery.budget().exchange(
      [&](const auto& value) { return ofFirst(value, context); });
  const std::string bytes =
      ofFirst(context.isFirst() ? packed(state.result) : std::string(), context);
  if (!context.isFirst())
    unpack(bytes, state.result);
}

/** Runs a stage as a transaction: the result is unchanged if the stage is reverted or cancelled. */
StageEnd
runAlone(Stage& stage, SlamState& state, SlamContext& context)
{
  const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  const bool is_matching = stage.isMatching();
  const bool was_shared = std::exchange(context.is_shared, !is_matching);
  Slam6DResult before = state.result;
  StageEnd end = StageEnd::kDone;
  try {
    if (!is_matching || context.isFirst())
      end = stage.run(state, context);
    if (end == StageEnd::kReverted)
      state.result = std::move(before);
  } catch (const Cancelled&) {
    state.result = std::move(before);
    end = StageEnd::kStopped;
  }
  context.is_shared = was_shared;
  if (is_matching) {
    state.result.matching_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    end = ofFirst(end, context);
    takeResultOfFirst(state, context);
  }
  return end;
}

/** \return whether the result of a stage is known from an earlier, interrupted run */
bool
takeKnown(std::optional<std::uint64_t> key, SlamState& state, SlamContext& context)
{
  if (!key)
    return false;
  auto known = context.memory ? context.memory->relaxed(*key) : std::nullopt;
  const bool is_known = ofFirst(known.has_value(), context);
  if (known) {
    known->parameters = state.result.parameters;
    state.result = std::move(*known);
  }
  if (is_known)
    takeResultOfFirst(state, context);
  return is_known;
}
} // namespace

bool
runStages(const StageList& stages, SlamState& state, SlamContext& context)
{
  for (const auto& stage : stages) {
    if (!stage->isDue(state))
      continue;
    stage->prepare(state);
    const auto key = stage->key(state);
    const bool is_known = takeKnown(key, state, context);
    const StageEnd end = is_known ? StageEnd::kDone : runAlone(*stage, state, context);
    if (end == StageEnd::kStopped)
      return false;
    if (end == StageEnd::kDone)
      stage->finish(state, context);
    if (key && context.memory && !is_known)
      context.memory->keepRelaxed(*key, state.result);
  }
  return true;
}

} // namespace pcl6d::slam6d
