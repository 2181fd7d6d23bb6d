#include "smoothing.hpp"

#include <algorithm>
#include <cstddef>

#include "difmesh/constrained_smoothing.hpp"
#include "difmesh/smoothing.hpp"
#include "field_input.hpp"
#include "names.hpp"
#include "parse.hpp"
#include "text.hpp"

namespace difmesh::cli {
namespace {

/// The number of a kind that comes without, and what it may be.
struct KindRules {
  SmoothingKind kind;
  double usual;
  Range range;
  bool is_whole;
};

constexpr std::array<Named<SmoothingKind>, 4> kKinds{{{"laplacian", SmoothingKind::laplacian},
                                                      {"taubin", SmoothingKind::taubin},
                                                      {"flow", SmoothingKind::flow},
                                                      {"constrained", SmoothingKind::constrained}}};

constexpr std::array<KindRules, 4> kRules{{{SmoothingKind::laplacian, 1.0, {1.0, 1e6}, true},
                                           {SmoothingKind::taubin, 15.0, {1.0, 1e6}, true},
                                           {SmoothingKind::flow, 1.0, {1e-6, 1e6}, false},
                                           {SmoothingKind::constrained, 0.01, {1e-9, 0.5}, false}}};

const KindRules& rules_of(SmoothingKind kind) {
  return *std::find_if(kRules.begin(), kRules.end(),
                       [kind](const KindRules& rules) { return rules.kind == kind; });
}

Mesh smoothed(const Smoothing& smoothing, const SmoothingContext& context, const Mesh& mesh) {
  const int steps = static_cast<int>(smoothing.number);
  switch (smoothing.kind) {
    case SmoothingKind::laplacian: {
      LaplacianOptions options;
      options.steps = steps;
      options.threads = context.threads;
      options.progress = context.progress;
      return smooth_laplacian(mesh, options);
    }
    case SmoothingKind::taubin: {
      TaubinOptions options;
      options.steps = steps;
      options.threads = context.threads;
      options.progress = context.progress;
      return smooth_taubin(mesh, options);
    }
    case SmoothingKind::flow: {
      const double cell = least_edge(context.grid);
      CurvatureFlowOptions options;
      options.time = smoothing.number * cell * cell;
      options.threads = context.threads;
      options.progress = context.progress;
      return smooth_by_curvature_flow(mesh, options);
    }
    case SmoothingKind::constrained:
      break;
  }
  ConstrainedSmoothingOptions options;
  options.tolerance = smoothing.number;
  options.threads = context.threads;
  options.progress = context.progress;
  return smooth_within_fractions(mesh, context.grid, options).mesh;
}

}  // namespace

Smoothing parse_smoothing(const std::string& option, const std::string& text) {
  const std::size_t colon = text.find(':');
  Smoothing smoothing;
  smoothing.kind = parse_name(option, text.substr(0, colon), kKinds);
  const KindRules& rules = rules_of(smoothing.kind);
  smoothing.number = rules.usual;
  if (colon != std::string::npos) {
    const std::string number = text.substr(colon + 1);
    smoothing.number = rules.is_whole
                           ? static_cast<double>(parse_integer(
                                 option, number, static_cast<std::int64_t>(rules.range.low),
                                 static_cast<std::int64_t>(rules.range.high)))
                           : parse_number(option, number, rules.range);
  }
  return smoothing;
}

std::string smoothing_text(const Smoothing& smoothing) {
  return std::string(name_of(kKinds, smoothing.kind)) + ":" + exact(smoothing.number);
}

void smooth_surface(const Smoothing& smoothing, const SmoothingContext& context, Mesh& mesh) {
  mesh = smoothed(smoothing, context, mesh);
}

}  // namespace difmesh::cli
