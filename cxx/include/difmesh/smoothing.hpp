#pragma once
/// \file smoothing.hpp
/// Smoothing of triangle meshes: moves vertices, keeps triangles. For the constrained kind see
/// constrained_smoothing.hpp.
///
/// Each function takes positions and triangles, in any unit, and returns a position per vertex, or
/// a mesh, and returns it with_positions() (vertex_normals.hpp): with the normals of the smooth
/// surface, where it has normals. Vertices without triangles stay. None looks at volumes, and none
/// keeps a mesh from cutting itself.
///
/// \throw Error invalid_argument for options out of range, an index out of range (the triangle is
///   named) or a position that is not finite (the vertex is named); too_large beyond 2^32 - 1
///   vertices; cancelled
/// Thread safety: concurrent calls are safe.

#include <array>
#include <cstdint>
#include <span>

#include "difmesh/mesh.hpp"
#include "difmesh/names.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

/// What happens to vertices on boundaries, that is on edges with other than two triangles.
enum class BoundaryVertices : std::uint8_t {
  stay,   ///< where they are
  along,  ///< see only their neighbours along the boundary: loops stay in their planes
};
/// Their words; see names.hpp.
inline constexpr std::array<Named<BoundaryVertices>, 2> kBoundaryVertices{
    {{"stay", BoundaryVertices::stay}, {"along", BoundaryVertices::along}}};

struct LaplacianOptions {
  int steps = 1;        ///< [0, 10^6]
  double factor = 1.0;  ///< share of the way to the neighbours' mean; (0, 1]
  BoundaryVertices boundary = BoundaryVertices::stay;
  int threads = 0;         ///< at most this many, 0: as the machine has; changes no bit
  Progress progress = {};  ///< may be empty; see options.hpp
};

/// Moves every vertex to p + factor Σ(p_i - p)/n, over its n neighbours, all at once. Shrinks.
/// Cost: O(vertices) per step, some 15 ns each. Memory: 70 bytes per vertex.
/// Source: E19 (options.hpp), equation 3.
[[nodiscard]] Array<Vec3> smooth_laplacian(std::span<const Vec3> positions,
                                           std::span<const Triangle> triangles,
                                           const LaplacianOptions& options = {});
[[nodiscard]] Mesh smooth_laplacian(const Mesh& mesh, const LaplacianOptions& options = {});

struct TaubinOptions {
  int steps = 15;          ///< each one move inwards and one outwards; [0, 10^6]
  double lambda = 0.6307;  ///< share of the way to the neighbours' mean; (0, 1]
  /// Frequency below which nothing is damped, k_pb = 1/lambda + 1/mu, where mu < 0 is the share of
  /// the outward move. Frequencies are eigenvalues of the mean's difference, 0 to 2. Above 0 and
  /// below 1/lambda, and such that the highest frequency is not amplified:
  /// |(1 - 2 lambda)(1 - 2 mu)| <= 1.
  double pass_band = 0.1;
  BoundaryVertices boundary = BoundaryVertices::stay;
  int threads = 0;         ///< at most this many, 0: as the machine has; changes no bit
  Progress progress = {};  ///< may be empty; see options.hpp
};

/// λ|μ smoothing: moves by lambda, then by mu of the way to the neighbours' mean. Hardly shrinks:
/// frequencies at and below the pass band are slightly amplified.
/// Cost: twice that of smooth_laplacian().
/// Source: G. Taubin, A signal processing approach to fair surface design, SIGGRAPH 1995.
[[nodiscard]] Array<Vec3> smooth_taubin(std::span<const Vec3> positions,
                                        std::span<const Triangle> triangles,
                                        const TaubinOptions& options = {});
[[nodiscard]] Mesh smooth_taubin(const Mesh& mesh, const TaubinOptions& options = {});

struct CurvatureFlowOptions {
  int steps = 1;  ///< [0, 10^6]
  /// How long the surface flows in each step, in the square of the positions' unit; > 0. Waves of
  /// length l are damped by 1 + 4 pi² time/l².
  double time = 1.0;
  double residual = 1e-10;  ///< of the linear systems over the first one; [1e-14, 0.1]
  int threads = 0;          ///< at most this many, 0: as the machine has; changes no bit
  Progress progress = {};   ///< may be empty; see options.hpp
};

/// Flow along the normal at a speed of twice the mean curvature, by implicit steps: solves
/// (A + time L) q = A p, with A the vertices' areas (a third of their triangles') and L the
/// cotangent Laplacian of the positions before the step, by conjugate gradients. A sphere of radius
/// R shrinks to sqrt(R² - 4 time steps), about. Boundary vertices stay. Triangles flatter than 1e-6
/// of their longest side count as that high. Where the gradients do not reach the tolerance in 10^4
/// iterations, what they have reached is taken.
/// Cost: O(vertices) per iteration of the gradients, the more the longer the time; 5 to 13 µs per
/// vertex for a step of the square of the edges' length.
/// Source: M. Desbrun, M. Meyer, P. Schroeder, A. H. Barr, Implicit fairing of irregular meshes
/// using diffusion and curvature flow, SIGGRAPH 1999.
[[nodiscard]] Array<Vec3> smooth_by_curvature_flow(std::span<const Vec3> positions,
                                                   std::span<const Triangle> triangles,
                                                   const CurvatureFlowOptions& options = {});
[[nodiscard]] Mesh smooth_by_curvature_flow(const Mesh& mesh,
                                            const CurvatureFlowOptions& options = {});

}  // namespace difmesh
