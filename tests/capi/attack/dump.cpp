#include "specimen.hpp"
#include "text.hpp"

namespace difmesh::attack {
namespace {

struct TypeNames {
  std::int32_t type;
  const char* constant;
  const char* element;
};
constexpr TypeNames kTypes[] = {{DIF_FLOAT32, "DIF_FLOAT32", "float"},
                                {DIF_FLOAT64, "DIF_FLOAT64", "double"},
                                {DIF_UINT8, "DIF_UINT8", "uint8_t"},
                                {DIF_UINT16, "DIF_UINT16", "uint16_t"}};
constexpr const char* kPlacements[] = {"DEFAULT", "MIDPOINT", "LINEAR", "MANSON", "PLIC", "CURVED"};
constexpr const char* kNormals[] = {"DEFAULT",         "YOUNGS", "MYC",
                                    "HEIGHT_FUNCTION", "ELVIRA", "LVIRA"};
constexpr const char* kSides[] = {"DEFAULT", "OPEN", "MIRROR", "PERIODIC", "EMPTY", "FULL"};

std::string dump_values(const Specimen& s) {
  std::string words = "{";
  Index3 cell{};
  for (cell[2] = 0; cell[2] < s.dims[2]; ++cell[2]) {
    words += cell[2] == 0 ? "{" : ", {";
    for (cell[1] = 0; cell[1] < s.dims[1]; ++cell[1]) {
      words += cell[1] == 0 ? "{" : ", {";
      for (cell[0] = 0; cell[0] < s.dims[0]; ++cell[0]) {
        words += text("%s%.17g", cell[0] == 0 ? "" : ", ", s.values[s.element(cell)]);
      }
      words += "}";
    }
    words += "}";
  }
  return words + "};\n";
}

std::string dump_options(const dif_options& options) {
  std::string words =
      text("options.placement = DIF_PLACEMENT_%s;\noptions.normals = DIF_NORMALS_%s;\n",
           kPlacements[options.placement], kNormals[options.normals]);
  words += "sides (x low, x high, y low, ...):";
  for (const std::int32_t side : options.boundary) {
    words += text(" DIF_SIDE_%s", kSides[side]);
  }
  return words + text(
                     "\noptions.purity_tolerance = %.17g;\noptions.overshoot_bound = %.17g;\n"
                     "options.clearance = %.17g;\n",
                     options.purity_tolerance, options.overshoot_bound, options.clearance);
}

}  // namespace

std::string dump(const Specimen& s) {
  const TypeNames* type = kTypes;
  while (type->type != s.type) {
    ++type;
  }
  std::string words = text("%s c[%d][%d][%d] = ", type->element, static_cast<int>(s.dims[2]),
                           static_cast<int>(s.dims[1]), static_cast<int>(s.dims[0]));
  words += dump_values(s);
  words += dump_options(s.options);
  words += text("field.origin = {%.17g, %.17g, %.17g};\n", s.origin[0], s.origin[1], s.origin[2]);
  words +=
      text("field.spacing = {%.17g, %.17g, %.17g};\n", s.spacing[0], s.spacing[1], s.spacing[2]);
  words += text("axes in memory: %zu %zu %zu, gaps: %d %d %d\n", s.memory_order[0],
                s.memory_order[1], s.memory_order[2], s.gaps[0], s.gaps[1], s.gaps[2]);
  for (std::size_t a = 0; a < 3; ++a) {
    for (const std::int64_t cut : s.cuts[a]) {
      words += text("cut in %c at %d\n", "xyz"[a], static_cast<int>(cut));
    }
  }
  return words + text("more ghosts: %d; other threads: %d; variants: %#x\n",
                      static_cast<int>(s.more_ghosts), s.other_threads, s.variants);
}

}  // namespace difmesh::attack
