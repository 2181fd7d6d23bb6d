#pragma once
/// \file float_settings.hpp
/// Floating-point settings as a caller may have them.

#include <cfenv>

namespace difmesh::attack {

/// Another rounding mode and no raised flag, as long as it lives.
class OtherFloatSettings {
 public:
  /// \param number chooses the rounding mode
  explicit OtherFloatSettings(unsigned number);
  OtherFloatSettings(const OtherFloatSettings&) = delete;
  OtherFloatSettings& operator=(const OtherFloatSettings&) = delete;
  ~OtherFloatSettings();

  /// True if the rounding mode is that still, and no flag was raised.
  [[nodiscard]] bool are_untouched() const;

 private:
  std::fenv_t before_;
  int rounding_;
};

}  // namespace difmesh::attack
