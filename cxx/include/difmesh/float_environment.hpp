#pragma once
/// \file float_environment.hpp
/// The settings with which a thread computes with floating-point numbers, and the default ones.
///
/// Programs change them: feenableexcept() and gfortran -ffpe-trap make errors fatal, fesetround()
/// rounds elsewhere, -ffast-math takes subnormal numbers for 0. Functions of difmesh that take
/// fields, grids, meshes, files or arrays of points compute with the default settings, on all their
/// threads, and leave those of the calling thread as they found them, raised flags included; so
/// their results do not depend on them. Callbacks find the default settings too. What is computed
/// of a single plane or point takes the settings that there are.

#include <cfenv>
#include <cstdint>

namespace difmesh {

/// Rounding mode, traps, raised flags and, on machines that can do that, whether subnormal numbers
/// count as 0.
class FloatEnvironment {
 public:
  /// That of the calling thread.
  [[nodiscard]] static FloatEnvironment current() noexcept;
  /// Makes it that of the calling thread. Raises nothing.
  void set() const noexcept;
  /// The same without its raised flags.
  void set_without_flags() const noexcept;
  /// Sets the default: round to nearest, no traps, no flags, subnormal numbers as they are.
  static void set_default() noexcept;
  /// True if the calling thread surely has the default, raised flags aside.
  [[nodiscard]] static bool is_default() noexcept;

 private:
#if defined(__x86_64__) && defined(__GNUC__)
  std::uint32_t vector_ = 0;  // MXCSR, with flags
  std::uint16_t x87_control_ = 0;
  std::uint16_t x87_flags_ = 0;
#else
  std::fenv_t state_{};
#endif
};

/// While it lives, the thread that made it has the default settings. Ends on the same thread.
/// Cost: some 20 ns on x86-64.
class DefaultFloatEnvironment {
 public:
  DefaultFloatEnvironment() noexcept : before_(FloatEnvironment::current()) {
    FloatEnvironment::set_default();
  }
  ~DefaultFloatEnvironment() { before_.set(); }
  DefaultFloatEnvironment(const DefaultFloatEnvironment&) = delete;
  DefaultFloatEnvironment& operator=(const DefaultFloatEnvironment&) = delete;

 private:
  FloatEnvironment before_;
};

}  // namespace difmesh
