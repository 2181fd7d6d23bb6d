#include "bodies.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "support/vec3.hpp"

namespace difmesh::paper {
namespace {

using test::add;
using test::dot;
using test::length;
using test::scaled;
using test::subtract;

constexpr std::int64_t kMargin = 5;
constexpr Vec3 kTurn{11.0, 23.0, 37.0};

Body from_shape(std::string name, ShapeOptions options, const Vec3& turn) {
  const Bounds box = make_shape(options).bounds();
  options.rotation_degrees = turn;
  return {std::move(name), "D", length(subtract(box.high, box.low)),
          std::make_shared<Shape>(make_shape(options)), nullptr};
}

Bounds bounds_of(const Body& body) {
  if (body.shape) {
    return body.shape->bounds();
  }
  const Measure facts = measure(*body.mesh);
  return {facts.low, facts.high};
}

using Matrix = std::array<Vec3, 3>;

/// Of second derivatives, by central differences of the gradient: off by 1e-8 of the curvature or
/// less.
Matrix hessian(const Shape& shape, const Vec3& point, double size) {
  const double step = 1e-5 * size;
  Matrix result;
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 low = point;
    Vec3 high = point;
    low[a] -= step;
    high[a] += step;
    result[a] =
        scaled(subtract(shape.gradient(high), shape.gradient(low)), 1.0 / (high[a] - low[a]));
  }
  return result;
}

/// Of the level set through a point; R. Goldman, Comput. Aided Geom. Des. 22 (2005) 632-658.
Curvatures level_set_curvatures(const Vec3& g, const Matrix& h) {
  const double steepness = length(g);
  Vec3 hg{};
  Vec3 cg{};  // adjugate of h times g
  for (std::size_t a = 0; a < 3; ++a) {
    hg[a] = dot(h[a], g);
    const std::size_t b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t e = (d + 1) % 3;
      const std::size_t f = (d + 2) % 3;
      cg[a] += (h[b][e] * h[c][f] - h[b][f] * h[c][e]) * g[d];
    }
  }
  const double trace = h[0][0] + h[1][1] + h[2][2];
  return {(dot(g, g) * trace - dot(g, hg)) / (2.0 * std::pow(steepness, 3.0)),
          dot(g, cg) / std::pow(steepness, 4.0)};
}

}  // namespace

Body Body::sphere() {
  return {"sphere", "R", 1.0, std::make_shared<Shape>(make_shape({})), nullptr};
}

Body Body::genus() {
  return from_shape("genus", {.kind = ShapeKind::genus}, {0.0, 0.0, 0.0});
}

Body Body::turned_genus() {
  return from_shape("turned genus", {.kind = ShapeKind::genus}, kTurn);
}

Body Body::ellipsoid() {
  return from_shape("ellipsoid", {.kind = ShapeKind::ellipsoid}, kTurn);
}

Body Body::smooth_box() {
  return from_shape("smooth box", {.kind = ShapeKind::smooth_box}, kTurn);
}

Body Body::golf_ball() {
  return from_shape("golf ball", {.kind = ShapeKind::golf_ball}, {0.0, 0.0, 0.0});
}

Body Body::from_file(const std::filesystem::path& path, std::string name) {
  auto mesh = std::make_shared<Mesh>(read_mesh(path));
  const Measure facts = measure(*mesh);
  return {std::move(name), "D", length(subtract(facts.high, facts.low)), nullptr, std::move(mesh)};
}

Sample sample(const Body& body, double cells, std::uint64_t place, int threads) {
  test::Random random(0x9e3779b97f4a7c15U + place);
  const Bounds box = bounds_of(body);
  Sample result{body, {}, {}};
  for (std::size_t a = 0; a < 3; ++a) {
    const double spacing = body.size / cells;
    result.grid.spacing[a] = spacing;
    result.grid.dims[a] =
        static_cast<std::int64_t>(std::ceil((box.high[a] - box.low[a]) / spacing)) + 2 * kMargin +
        1;
    result.grid.origin[a] =
        box.low[a] - (static_cast<double>(kMargin) + random.uniform()) * spacing;
  }
  if (body.shape) {
    FractionsFromFunctionOptions options;
    options.threads = threads;
    result.fractions = fractions_from_shape(result.grid, *body.shape, options).fractions;
  } else {
    FractionsFromMeshOptions options;
    options.threads = threads;
    result.fractions =
        fractions_from_mesh(result.grid, body.mesh->positions, body.mesh->triangles, options)
            .fractions;
  }
  return result;
}

std::optional<Curvatures> exact_curvatures(const Body& body, const Vec3& point, double distance) {
  if (!body.shape || body.shape->options().kind == ShapeKind::golf_ball) {
    return {};
  }
  const Shape& shape = *body.shape;
  if (shape.options().kind == ShapeKind::sphere) {
    const double radius = shape.options().radius;
    return Curvatures{1.0 / radius, 1.0 / (radius * radius)};
  }
  const Vec3 uphill = shape.gradient(point);
  const Vec3 foot = add(point, scaled(uphill, -distance / length(uphill)));
  return level_set_curvatures(shape.gradient(foot), hessian(shape, foot, body.size));
}

}  // namespace difmesh::paper
