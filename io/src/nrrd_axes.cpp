#include "nrrd_axes.hpp"

#include <algorithm>
#include <array>

#include "text.hpp"
#include "value_cells.hpp"

namespace difmesh::detail {
namespace {

using Three = std::array<std::size_t, 3>;

constexpr std::array<std::string_view, 4> kSpatialKinds{"domain", "space", "???", "none"};

class AxisSetter {
 public:
  AxisSetter(const std::filesystem::path& path, const NrrdAxes& axes, NrrdHeader& header)
      : path_(path), axes_(axes), header_(header) {}

  void set() {
    read_sizes();
    check_files();
    const Three three = choose();
    for (std::size_t n = 0; n < 3; ++n) {
      header_.sizes[n] = sizes_[three[n]];
    }
    header_.spacings = numbers("spacings", three);
    header_.axis_mins = numbers("axismins", three);
    header_.axis_maxs = numbers("axismaxs", three);
    if (const NrrdAxisField* const centres = field("centers")) {
      for (std::size_t n = 0; n < 3; ++n) {
        header_.node_centred[n] = lower_case(centres->words[three[n]]) == "node";
      }
    }
    if (axes_.directions_line > 0) {
      header_.space_directions = {*axes_.directions[three[0]], *axes_.directions[three[1]],
                                  *axes_.directions[three[2]]};
    }
  }

 private:
  [[noreturn]] void fail(std::int64_t line, const std::string& matter) const {
    fail_format(path_, "NRRD header, line " + std::to_string(line) + ": " + matter);
  }

  /// Null where the header has no such field.
  [[nodiscard]] const NrrdAxisField* field(std::string_view name) const {
    const auto found = axes_.fields.find(name);
    if (found == axes_.fields.end()) {
      return nullptr;
    }
    const NrrdAxisField& field = found->second;
    if (field.words.size() != count()) {
      fail(field.line, "field '" + field.name + "' needs " + std::to_string(count()) +
                           " values and has " + std::to_string(field.words.size()));
    }
    return &field;
  }

  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(axes_.dimension); }

  void read_sizes() {
    const NrrdAxisField& sizes = *field("sizes");
    for (const std::string_view word : sizes.words) {
      const std::optional<std::int64_t> size = to_integer(word);
      if (!size) {
        fail(sizes.line, "size " + in_quotes(word) + " is no integer");
      }
      sizes_.push_back(*size);
    }
  }

  /// Each of several files holds as many samples as the others, along the last axes.
  void check_files() const {
    const std::int64_t files = static_cast<std::int64_t>(header_.data_files.size());
    if (!axes_.file_dimension) {
      return;
    }
    const bool told = *axes_.file_dimension != 0;
    const std::int64_t of_each = told ? *axes_.file_dimension : axes_.dimension - 1;
    std::int64_t pieces = 1;
    for (std::int64_t axis = std::max<std::int64_t>(of_each, 0); axis < axes_.dimension; ++axis) {
      if (__builtin_mul_overflow(pieces, sizes_[static_cast<std::size_t>(axis)], &pieces)) {
        pieces = 0;
      }
    }
    const bool slabs = (!told || of_each == axes_.dimension) && sizes_.back() % files == 0;
    const bool fits = slabs || pieces == files;
    if (of_each < 1 || of_each > axes_.dimension || !fits) {
      fail_format(path_, "the NRRD header has " + std::to_string(files) +
                             " data files of dimension " + std::to_string(of_each) +
                             ", which the sizes do not make up");
    }
  }

  /// The axes in space; all others have one sample.
  [[nodiscard]] Three choose() const {
    std::vector<bool> possible(count(), true);
    if (axes_.directions_line > 0 && axes_.directions.size() != count()) {
      fail(axes_.directions_line, "field 'space directions' needs " + std::to_string(count()) +
                                      " vectors and has " +
                                      std::to_string(axes_.directions.size()));
    }
    const NrrdAxisField* const kinds = field("kinds");
    for (std::size_t axis = 0; axis < count(); ++axis) {
      const std::string kind = kinds != nullptr ? lower_case(kinds->words[axis]) : "space";
      const bool spatial =
          std::find(kSpatialKinds.begin(), kSpatialKinds.end(), kind) != kSpatialKinds.end();
      const bool directed = axes_.directions_line == 0 || axes_.directions[axis];
      possible[axis] = spatial && directed;
      if (!spatial && (sizes_[axis] != 1 || axes_.dimension == 3)) {
        fail(kinds->line, "an axis of kind " + in_quotes(kinds->words[axis]) +
                              "; a field has three axes in space");
      }
      if (!directed && (sizes_[axis] != 1 || axes_.dimension == 3)) {
        fail(axes_.directions_line, "axis " + std::to_string(axis) +
                                        " has no space direction; a field has three axes in space");
      }
    }
    const std::optional<Three> three = axes_of_field(sizes_, possible);
    if (!three) {
      fail_format(path_, "an array of dimension " + std::to_string(count()) +
                             "; a field has dimension 3, and further axes of one sample only where "
                             "it is clear which they are");
    }
    return *three;
  }

  [[nodiscard]] std::optional<Vec3> numbers(std::string_view name, const Three& three) const {
    const NrrdAxisField* const numbers = field(name);
    if (numbers == nullptr) {
      return std::nullopt;
    }
    Vec3 result{};
    for (std::size_t n = 0; n < 3; ++n) {
      const std::string_view word = numbers->words[three[n]];
      const std::optional<double> number = to_number(word);
      if (!number) {
        fail(numbers->line,
             in_quotes(word) + " in field " + in_quotes(numbers->name) + " is no number");
      }
      result[n] = *number;
    }
    return result;
  }

  const std::filesystem::path& path_;
  const NrrdAxes& axes_;
  NrrdHeader& header_;
  std::vector<std::int64_t> sizes_;
};

}  // namespace

void set_axes(const std::filesystem::path& path, const NrrdAxes& axes, NrrdHeader& header) {
  AxisSetter(path, axes, header).set();
}

}  // namespace difmesh::detail
