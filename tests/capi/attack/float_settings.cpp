#include "float_settings.hpp"

namespace difmesh::attack {

OtherFloatSettings::OtherFloatSettings(unsigned number) {
  constexpr int kModes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  rounding_ = kModes[number % 3];
  std::fegetenv(&before_);
  std::fesetround(rounding_);
  std::feclearexcept(FE_ALL_EXCEPT);
}

OtherFloatSettings::~OtherFloatSettings() {
  std::fesetenv(&before_);
}

bool OtherFloatSettings::are_untouched() const {
  return std::fegetround() == rounding_ && std::fetestexcept(FE_ALL_EXCEPT) == 0;
}

}  // namespace difmesh::attack
