// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/haar_cascade.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Windows of equal size, stored side by side: one sweep computes a feature's
 * value in each window, bit for bit as CascadeEvaluator. */
class WindowBatch {
public:
  /** \param[in] windows of width x height pixels
   * \throws BadArgument a window has another size */
  WindowBatch(const std::vector<GrayImage>& windows,
              int width,
              int height,
              IntegralImage::Tables tables);

  std::size_t
  size() const
  {
    return factors_.size();
  }

  /** \param[out] values size() numbers */
  void
  valuesOf(const HaarFeature& feature, float* values) const;

private:
  int stride_;
  std::vector<std::uint32_t> sums_, tilted_; // entry of the table * size() + window
  std::vector<float> factors_;
};

/** \brief For each feature the windows ordered by its value: the best threshold takes
 * one sweep. */
class SortedFeatures {
public:
  static constexpr std::size_t kMostWindows = 0x7fff; ///< 15 bits each
  static constexpr std::size_t kMostPositives = kMostWindows / 2;

  /** \param[in] features candidates for the nodes of the trees; kept by reference, like
   * windows
   * \throws BadArgument more than kMostWindows windows, or no feature */
  SortedFeatures(const WindowBatch& windows,
                 const std::vector<HaarFeature>& features,
                 unsigned int num_threads = 0);

  /** A sample of the weighted least squares fit. */
  struct Weighted {
    float weight = 0;
    float response = 0; ///< weight times label
  };

  /** \brief The cut of a node. */
  struct Split {
    bool found = false; ///< false: no feature separates the samples
    std::size_t feature = 0;
    float threshold = 0;
    double gain = 0; ///< decrease of the weighted squared error
  };

  /** \return the split of the samples with weights above zero that leaves the smallest
   * squared error, each side answered by its mean label; of equal splits the first
   * feature
   * \param[in] samples one per window
   * \param[in] among indices of the features to choose from; empty: every feature */
  Split
  bestSplit(const std::vector<Weighted>& samples,
            const std::vector<std::size_t>& among = {}) const;

  const WindowBatch&
  windows() const
  {
    return windows_;
  }
  const std::vector<HaarFeature>&
  features() const
  {
    return features_;
  }

private:
  struct Cut {
    std::size_t place = 0; // the order is cut behind this index
    double gain = 0;
  };
  void
  sortFeature(std::size_t feature,
              std::vector<float>& values,
              std::vector<std::uint64_t>& keys,
              std::vector<std::uint64_t>& spare);
  Cut
  bestCut(std::size_t feature,
          const std::vector<Weighted>& samples,
          const double total_weight,
          const double total_response) const;
  float
  thresholdBehind(std::size_t feature, std::size_t place) const;

  const WindowBatch& windows_;
  const std::vector<HaarFeature>& features_;
  unsigned int num_threads_;
  std::vector<std::uint16_t>
      order_; // feature * windows + index; top bit: equal to the next
};

/** \brief Gentle AdaBoost: adds trees one by one. Each tree is the weighted
 * least-squares fit to the labels; weights grow where the sum of the trees is wrong.
 *
 * Equal results for any number of threads.
 * \note Source: J. Friedman, T. Hastie, R. Tibshirani, "Additive logistic regression: a
 * statistical view of boosting", Annals of Statistics 28(2), 2000, algorithm 4.
 * \ingroup object_localization */
class GentleBoost {
public:
  /** Keeps a reference to the features.
   * \param[in] labels +1 or -1, one per window
   * \param[in] splits nodes of each tree, in [1, 16]
   * \throws BadArgument not one label per window, a label other than +1 and -1, or
   * splits out of range */
  GentleBoost(const SortedFeatures& features, std::vector<int> labels, int splits = 1);

  /** \brief Adds a tree.
   * \param[in] among indices of the features to choose from; empty: every feature
   * \return false if no feature separates the windows */
  bool
  addTree(const std::vector<std::size_t>& among = {});

  /** \return the trees; their features are indices into SortedFeatures::features() */
  const std::vector<HaarTree>&
  trees() const
  {
    return trees_;
  }

  /** \return the sum of the trees' answers per window, bit for bit as
   * CascadeEvaluator */
  const std::vector<double>&
  sums() const
  {
    return sums_;
  }

private:
  struct Leaf;
  void
  searchSplit(Leaf& leaf, const std::vector<std::size_t>& among) const;
  void
  cut(const Leaf& leaf, HaarTree& tree, std::vector<Leaf>& leaves) const;
  std::vector<Leaf>
  grow(HaarTree& tree, const std::vector<std::size_t>& among) const;
  void
  reweigh(const std::vector<Leaf>& leaves, const HaarTree& tree);

  const SortedFeatures& features_;
  std::vector<int> labels_;
  int splits_;
  std::vector<double> weights_; // sum 1
  std::vector<double> sums_;
  std::vector<HaarTree> trees_;
};

} // namespace pcl6d
