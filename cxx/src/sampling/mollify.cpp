#include "difmesh/mollify.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "base/first_error.hpp"
#include "base/parallel.hpp"
#include "base/position_text.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "grid/block_field.hpp"

namespace difmesh {
namespace {

using namespace detail;

constexpr double kLeastRadius = 1.0;
constexpr double kGreatestRadius = 8.0;
constexpr std::int64_t kCellsPerPortion = 1 << 14;

/// A row of cells beside the centre's row, with the weights along it.
struct TapRow {
  std::int64_t j = 0;
  std::int64_t k = 0;
  std::vector<double> weights;  ///< of the cells -reach .. reach
};

class Kernel {
 public:
  explicit Kernel(double radius) : reach_(static_cast<std::int64_t>(std::ceil(radius)) - 1) {
    double sum = 0.0;
    for (std::int64_t k = -reach_; k <= reach_; ++k) {
      for (std::int64_t j = -reach_; j <= reach_; ++j) {
        TapRow row{j, k, {}};
        for (std::int64_t i = -reach_; i <= reach_; ++i) {
          const double inside =
              1.0 - static_cast<double>(i * i + j * j + k * k) / (radius * radius);
          row.weights.push_back(inside > 0.0 ? std::pow(inside, 4) : 0.0);
          sum += row.weights.back();
        }
        if (row.weights[static_cast<std::size_t>(reach_)] > 0.0) {
          rows_.push_back(row);
        }
      }
    }
    for (TapRow& row : rows_) {
      for (double& weight : row.weights) {
        weight /= sum;
      }
    }
  }
  [[nodiscard]] std::int64_t reach() const { return reach_; }
  [[nodiscard]] const std::vector<TapRow>& rows() const { return rows_; }

 private:
  std::int64_t reach_;
  std::vector<TapRow> rows_;
};

/// Least and greatest value of a row.
struct RowRange {
  double low = 0.0;
  double high = 0.0;
  [[nodiscard]] bool is_uniform(double value) const { return low == value && high == value; }
};

template <class T>
double value_of(T element) {
  if constexpr (std::is_integral_v<T>) {
    return fraction_of(element);
  } else {
    return static_cast<double>(element);
  }
}

template <class T>
class Convolution {
 public:
  Convolution(const BlockField& field, const Kernel& kernel)
      : field_(field),
        kernel_(kernel),
        dims_(field.grid.dims),
        ranges_(static_cast<std::size_t>(dims_[1] * dims_[2])) {}

  [[nodiscard]] std::int64_t rows() const { return dims_[1] * dims_[2]; }

  /// \throw Error invalid_value for the first cell of the row that is not finite
  void find_range(std::int64_t row) {
    const std::int64_t j = row % dims_[1];
    const std::int64_t k = row / dims_[1];
    const T* cells = first_of(j, k);
    RowRange range{std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
    for (std::int64_t i = 0; i < dims_[0]; ++i) {
      const double value = value_of(cells[i * field_.view.strides[0]]);
      if (!std::isfinite(value)) {
        throw Error(ErrorCode::invalid_value, "mollify: cell (" + std::to_string(i) + ", " +
                                                  std::to_string(j) + ", " + std::to_string(k) +
                                                  ") is " + rounded_text(value));
      }
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
    ranges_[static_cast<std::size_t>(row)] = range;
  }

  /// \param line room for a row and the kernel's reach on both sides
  void fill_row(std::int64_t row, std::vector<double>& line, double* result) const {
    const std::int64_t j = row % dims_[1];
    const std::int64_t k = row / dims_[1];
    const T* cells = first_of(j, k);
    for (std::int64_t i = 0; i < dims_[0]; ++i) {
      result[i] = 0.0;
    }
    std::vector<double> centre(static_cast<std::size_t>(dims_[0]));
    for (std::int64_t i = 0; i < dims_[0]; ++i) {
      centre[static_cast<std::size_t>(i)] = value_of(cells[i * field_.view.strides[0]]);
    }
    if (!is_uniform_around(j, k, centre[0])) {
      for (const TapRow& tap : kernel_.rows()) {
        read_line(j + tap.j, k + tap.k, line);
        add(tap, line, centre, result);
      }
    }
    for (std::int64_t i = 0; i < dims_[0]; ++i) {
      result[i] = put_back(centre[static_cast<std::size_t>(i)] + result[i]);
    }
  }

 private:
  // Rounding must not make overshoots of averages.
  static double put_back(double value) {
    constexpr double kRounding = 1e-14;
    return value < 0.0 && value > -kRounding        ? 0.0
           : value > 1.0 && value < 1.0 + kRounding ? 1.0
                                                    : value;
  }

  [[nodiscard]] const T* first_of(std::int64_t j, std::int64_t k) const {
    return static_cast<const T*>(field_.view.data) + field_.element({0, j, k});
  }

  // What the rows (j, k) and beyond are: a row of the field, or all 0 or all 1.
  [[nodiscard]] Index3 resolve(std::int64_t j, std::int64_t k) const {
    return {0, field_.axes[1].resolve(j), field_.axes[2].resolve(k)};
  }
  static bool is_row(const Index3& resolved) {
    return is_cell(resolved[1]) && is_cell(resolved[2]);
  }

  // True if all that the kernel reaches from this row has this value.
  [[nodiscard]] bool is_uniform_around(std::int64_t j, std::int64_t k, double value) const {
    const std::int64_t reach = kernel_.reach();
    for (const Side side : {field_.side(0, 0), field_.side(0, 1)}) {
      if (reach > 0 &&
          ((side == Side::empty && value != 0.0) || (side == Side::full && value != 1.0))) {
        return false;
      }
    }
    return std::all_of(kernel_.rows().begin(), kernel_.rows().end(), [&](const TapRow& tap) {
      const Index3 resolved = resolve(j + tap.j, k + tap.k);
      if (!is_row(resolved)) {
        return field_.fraction(resolved) == value;
      }
      return ranges_[static_cast<std::size_t>(resolved[2] * dims_[1] + resolved[1])].is_uniform(
          value);
    });
  }

  void read_line(std::int64_t j, std::int64_t k, std::vector<double>& line) const {
    const std::int64_t reach = kernel_.reach();
    Index3 resolved = resolve(j, k);
    const bool row = is_row(resolved);
    const T* cells = row ? first_of(resolved[1], resolved[2]) : nullptr;
    const double beyond = row ? 0.0 : field_.fraction(resolved);
    for (std::int64_t i = -reach; i < dims_[0] + reach; ++i) {
      double& value = line[static_cast<std::size_t>(i + reach)];
      resolved[0] = i < 0 || i >= dims_[0] ? field_.axes[0].resolve(i) : i;
      if (!is_cell(resolved[0])) {
        value = field_.fraction(resolved);
      } else {
        value = row ? value_of(cells[resolved[0] * field_.view.strides[0]]) : beyond;
      }
    }
  }

  // Differences from the centre: constants are kept to the bit.
  void add(const TapRow& tap, const std::vector<double>& line, const std::vector<double>& centre,
           double* result) const {
    for (std::size_t t = 0; t < tap.weights.size(); ++t) {
      const double weight = tap.weights[t];
      if (weight > 0.0) {
        for (std::size_t i = 0; i < centre.size(); ++i) {
          result[i] += weight * (line[i + t] - centre[i]);
        }
      }
    }
  }

  const BlockField& field_;
  const Kernel& kernel_;
  Index3 dims_;
  std::vector<RowRange> ranges_;
};

/// The field with mirrors for open sides.
BlockField checked_field(const FieldView& field, const MollifyOptions& options) {
  if (!(options.radius >= kLeastRadius && options.radius <= kGreatestRadius)) {
    throw Error(ErrorCode::invalid_argument,
                "mollify: radius must be 1 to 8 cells, got " + rounded_text(options.radius));
  }
  Options checked;
  checked.boundary = options.boundary;
  checked.threads = options.threads;
  for (Side& side : checked.boundary) {
    side = side == Side::open ? Side::mirror : side;
  }
  const Grid grid{.dims = field.dims};
  const Block whole{{0, 0, 0}, field.dims, {0, 0, 0}, {0, 0, 0}};
  BlockField result = make_block_field(field, whole, grid, checked);
  if (grid.cell_count() > std::numeric_limits<std::ptrdiff_t>::max() / 8) {
    throw Error(ErrorCode::too_large, "mollify: the field has " +
                                          std::to_string(grid.cell_count()) +
                                          " cells; as numbers they exceed 2^63 bytes");
  }
  return result;
}

}  // namespace

Array<double> mollify(const FieldView& field, const MollifyOptions& options) {
  const DefaultFloatEnvironment environment;
  const BlockField block = checked_field(field, options);
  const Kernel kernel(options.radius);
  Workers workers(options.threads);
  Phases phases(workers, options.progress);
  const std::int64_t length = block.grid.dims[0];
  const std::int64_t grain = std::max<std::int64_t>(1, kCellsPerPortion / length);
  Array<double> result;
  with_scalar(field.type, [&](auto type) {
    Convolution<decltype(type)> convolution(block, kernel);
    FirstError error;
    phases.run(0.2, convolution.rows(), grain, [&](std::int64_t begin, std::int64_t end) {
      error.guard(begin, [&] {
        for (std::int64_t row = begin; row < end; ++row) {
          convolution.find_range(row);
        }
      });
    });
    error.rethrow();
    result.resize(static_cast<std::size_t>(block.grid.cell_count()));
    phases.run(0.8, convolution.rows(), grain, [&](std::int64_t begin, std::int64_t end) {
      std::vector<double> line(static_cast<std::size_t>(length + 2 * kernel.reach()));
      for (std::int64_t row = begin; row < end; ++row) {
        convolution.fill_row(row, line, result.data() + row * length);
      }
    });
  });
  phases.finish();
  return result;
}

}  // namespace difmesh
