#pragma once
/// \file names.hpp
/// What the choices of the library are called: one word per enumerator, the same on the command
/// line, in reports, in Python and, in capitals, in C. The order is that of C's constants.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "difmesh/options.hpp"
#include "difmesh/values.hpp"

namespace difmesh {

/// A value and its word.
template <class Value>
struct Named {
  std::string_view name;
  Value value;
};

inline constexpr std::array<Named<Placement>, 5> kPlacements{{{"midpoint", Placement::midpoint},
                                                              {"linear", Placement::linear},
                                                              {"manson", Placement::manson},
                                                              {"plic", Placement::plic},
                                                              {"curved", Placement::curved}}};

inline constexpr std::array<Named<Normals>, 5> kNormals{
    {{"youngs", Normals::youngs},
     {"myc", Normals::myc},
     {"height_function", Normals::height_function},
     {"elvira", Normals::elvira},
     {"lvira", Normals::lvira}}};

inline constexpr std::array<Named<Side>, 5> kSides{{{"open", Side::open},
                                                    {"mirror", Side::mirror},
                                                    {"periodic", Side::periodic},
                                                    {"empty", Side::empty},
                                                    {"full", Side::full}}};

inline constexpr std::array<Named<ValueType>, 10> kValueTypes{{{"float32", ValueType::float32},
                                                               {"float64", ValueType::float64},
                                                               {"uint8", ValueType::uint8},
                                                               {"uint16", ValueType::uint16},
                                                               {"int8", ValueType::int8},
                                                               {"int16", ValueType::int16},
                                                               {"int32", ValueType::int32},
                                                               {"uint32", ValueType::uint32},
                                                               {"int64", ValueType::int64},
                                                               {"uint64", ValueType::uint64}}};

/// The word of a value; empty for none that the table has.
template <class Value, std::size_t n>
[[nodiscard]] constexpr std::string_view name_of(const std::array<Named<Value>, n>& table,
                                                 Value value) {
  const auto* const found =
      std::find_if(table.begin(), table.end(),
                   [value](const Named<Value>& each) { return each.value == value; });
  return found == table.end() ? std::string_view() : found->name;
}

}  // namespace difmesh
