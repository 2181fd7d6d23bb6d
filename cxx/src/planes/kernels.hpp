#pragma once
// The inner loops that are worth vector instructions: compiled for several instruction sets, of
// which the best that the machine has is chosen at run time. All give the same bits.

#include <cstdint>

namespace difmesh::detail {

/// How many cells or edges a kernel takes at once.
inline constexpr int kBatch = 16;

/// Cells on each side of the middle one in a column of heights.
inline constexpr int kColumnReach = 4;

/// What the heights of a field of T go by, and how the field lies in memory.
template <class T>
struct PlaneTask {
  std::int64_t strides[3];  ///< the first is 1
  bool centred_columns;     ///< else Youngs' normals
  bool heights;
  T least_full;  ///< the least value that counts as full
  T most_empty;  ///< the greatest that counts as empty
};

/// Of CellBatch::reach: what follows the cell along x is in memory so far that columns across x can
/// be read from the one before it on, eight abreast.
inline constexpr unsigned kEightAbreast = 8;
inline constexpr int kAbreast = 8;

/// Cells, at least one, whose 3x3x3 neighbourhoods are in memory, and what follows these along x:
/// rows are read four abreast.
template <class T>
struct CellBatch {
  const T* const* centre;
  /// Bit per axis: so are the columns of heights along it; kEightAbreast.
  const std::uint8_t* reach;
  int count;  ///< at most kBatch
};

/// Bits of the masks are cells of the batch.
struct PlaneBatch {
  double m[3][kBatch];
  double a[kBatch];
  unsigned gradient_free;  ///< m and a say nothing
  unsigned from_heights;
  unsigned from_youngs;  ///< unless from heights; the others are from centred columns
  unsigned undone;       ///< m and a say nothing: the cell needs the general code
};

/// Four doubles, m and then a; see unit_plane.hpp, which is not included: what is compiled here for
/// wide vectors must hold no inline functions that the rest of the library has too.
struct UnitPlane;

/// Edges and the planes of the cells at their ends; the places past `count` must hold some edge
/// too.
struct WindowBatch {
  const UnitPlane* lower[kBatch];
  const UnitPlane* upper[kBatch];
  std::uint8_t axis[kBatch];
  double sense[kBatch];  ///< 1 where the upper end is inside, else -1
  int count;
  double share[kBatch];  ///< of the way from the lower end to the upper one
  double steps[kBatch];
  unsigned undone;  ///< edges where the share filled may not be monotone: no result
};

/// For plane_fit.hpp: the neighbours that are there, and the cell itself. What is past `count` must
/// be numbers.
inline constexpr int kFitCells = 32;
struct FitTask {
  double fraction[kFitCells];
  double shift[3][kFitCells];  ///< from the cell, in cells
  int count;
  double centre;  ///< the fraction of the cell itself
  double m[3];    ///< the start; then the result
};

/// Groups of 64 cells in a row of memory: one word of bits each.
inline constexpr std::int64_t kGroup = 64;

template <class T>
struct GroupTask {
  const T* values;
  std::int64_t groups;  ///< at most 64
  T low;                ///< interfacial is what lies strictly between these
  T high;
};

/// Facts about groups are added to what is there.
struct GroupFacts {
  std::uint64_t inside[64];  ///< per group, the cells with γ >= 1/2
  std::uint64_t outside;     ///< one bit per group: holds values that are not in [0,1]
  std::int64_t interfacial;
  double sum;  ///< of the clamped fractions; groups are added in their order
};

template <class T>
using ClassifyGroups = void (*)(const GroupTask<T>&, GroupFacts&);

template <class T>
using FitPlanes = void (*)(const PlaneTask<T>&, const CellBatch<T>&, PlaneBatch&);

struct Kernels {
  FitPlanes<float> fit_planes_float;
  FitPlanes<double> fit_planes_double;
  FitPlanes<std::uint8_t> fit_planes_uint8;
  FitPlanes<std::uint16_t> fit_planes_uint16;
  void (*solve_windows)(WindowBatch&);
  void (*fit_plane_to_neighbours)(FitTask&);
  ClassifyGroups<float> classify_float;
  ClassifyGroups<double> classify_double;

  [[nodiscard]] FitPlanes<float> fit_planes(float) const { return fit_planes_float; }
  [[nodiscard]] FitPlanes<double> fit_planes(double) const { return fit_planes_double; }
  [[nodiscard]] FitPlanes<std::uint8_t> fit_planes(std::uint8_t) const { return fit_planes_uint8; }
  [[nodiscard]] FitPlanes<std::uint16_t> fit_planes(std::uint16_t) const {
    return fit_planes_uint16;
  }
};

// Integers are classified by the general code.
[[nodiscard]] inline ClassifyGroups<float> classify_kernel(const Kernels& kernels, float) {
  return kernels.classify_float;
}
[[nodiscard]] inline ClassifyGroups<double> classify_kernel(const Kernels& kernels, double) {
  return kernels.classify_double;
}

enum class Instructions : std::uint8_t { baseline, avx2, avx512 };

/// True if the machine has them and the library was built with them.
[[nodiscard]] bool has_instructions(Instructions instructions);

/// The kernels for the best instructions that the machine has. Thread safety: safe.
[[nodiscard]] const Kernels& kernels();

/// For tests and benchmarks: which those are, and to use others, in all calls that begin later.
/// \pre has_instructions()
[[nodiscard]] Instructions instructions_in_use();
void use_instructions(Instructions instructions);

namespace baseline {
extern const Kernels kKernels;
}
namespace avx2 {
extern const Kernels kKernels;
}
namespace avx512 {
extern const Kernels kKernels;
}

}  // namespace difmesh::detail
