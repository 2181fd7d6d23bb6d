#pragma once
// Sums and extremes of distances, from portions of the points.

#include <cmath>
#include <cstdint>
#include <limits>

#include "difmesh/metrics/distance.hpp"

namespace difmesh::detail {

/// Add and merge in a fixed order, for the same bits.
struct Tally {
  std::int64_t points = 0;
  double weight = 0.0;
  double sum = 0.0;
  double sum_of_sizes = 0.0;
  double sum_of_squares = 0.0;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  double maximum = -1.0;
  std::int64_t maximum_index = -1;
  Vec3 maximum_position{0, 0, 0};

  /// A point that takes part in the means alone.
  void add_to_means(double distance, double point_weight) {
    weight += point_weight;
    sum += point_weight * distance;
    sum_of_sizes += point_weight * std::abs(distance);
    sum_of_squares += point_weight * distance * distance;
  }
  void add(double distance, double point_weight, std::int64_t index, const Vec3& position) {
    add_to_means(distance, point_weight);
    ++points;
    lowest = distance < lowest ? distance : lowest;
    highest = distance > highest ? distance : highest;
    raise_maximum(std::abs(distance), index, position);
  }
  void merge(const Tally& later) {
    points += later.points;
    weight += later.weight;
    sum += later.sum;
    sum_of_sizes += later.sum_of_sizes;
    sum_of_squares += later.sum_of_squares;
    lowest = later.lowest < lowest ? later.lowest : lowest;
    highest = later.highest > highest ? later.highest : highest;
    raise_maximum(later.maximum, later.maximum_index, later.maximum_position);
  }
  /// \param scale of the distances that were added
  [[nodiscard]] DistanceStatistics statistics(double scale) const {
    return {points,
            std::sqrt(sum_of_squares / weight) / scale,
            sum_of_sizes / weight / scale,
            sum / weight / scale,
            lowest / scale,
            highest / scale,
            maximum / scale,
            maximum_index,
            maximum_position};
  }

 private:
  void raise_maximum(double size, std::int64_t index, const Vec3& position) {
    if (size > maximum) {
      maximum = size;
      maximum_index = index;
      maximum_position = position;
    }
  }
};

}  // namespace difmesh::detail
