#include "difmesh/io/color_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace difmesh {
namespace {

/// 256 colours of six hexadecimal digits, as matplotlib has them.
constexpr std::string_view kViridis =
    "44015444025645045745055946075a46085c460a5d460b5e470d60470e61471063471164471365481467"
    "48166848176948186a481a6c481b6d481c6e481d6f481f70482071482173482374482475482576482677"
    "482878482979472a7a472c7a472d7b472e7c472f7d46307e46327e46337f463480453581453781453882"
    "443983443a83443b84433d84433e85423f854240864241864142874144874045884046883f47883f4889"
    "3e49893e4a893e4c8a3d4d8a3d4e8a3c4f8a3c508b3b518b3b528b3a538b3a548c39558c39568c38588c"
    "38598c375a8c375b8d365c8d365d8d355e8d355f8d34608d34618d33628d33638d32648e32658e31668e"
    "31678e31688e30698e306a8e2f6b8e2f6c8e2e6d8e2e6e8e2e6f8e2d708e2d718e2c718e2c728e2c738e"
    "2b748e2b758e2a768e2a778e2a788e29798e297a8e297b8e287c8e287d8e277e8e277f8e27808e26818e"
    "26828e26828e25838e25848e25858e24868e24878e23888e23898e238a8d228b8d228c8d228d8d218e8d"
    "218f8d21908d21918c20928c20928c20938c1f948c1f958b1f968b1f978b1f988b1f998a1f9a8a1e9b8a"
    "1e9c891e9d891f9e891f9f881fa0881fa1881fa1871fa28720a38620a48621a58521a68522a78522a884"
    "23a98324aa8325ab8225ac8226ad8127ad8128ae8029af7f2ab07f2cb17e2db27d2eb37c2fb47c31b57b"
    "32b67a34b67935b77937b87838b9773aba763bbb753dbc743fbc7340bd7242be7144bf7046c06f48c16e"
    "4ac16d4cc26c4ec36b50c46a52c56954c56856c66758c7655ac8645cc8635ec96260ca6063cb5f65cb5e"
    "67cc5c69cd5b6ccd5a6ece5870cf5773d05675d05477d1537ad1517cd2507fd34e81d34d84d44b86d549"
    "89d5488bd6468ed64590d74393d74195d84098d83e9bd93c9dd93ba0da39a2da37a5db36a8db34aadc32"
    "addc30b0dd2fb2dd2db5de2bb8de29bade28bddf26c0df25c2df23c5e021c8e020cae11fcde11dd0e11c"
    "d2e21bd5e21ad8e219dae319dde318dfe318e2e418e5e419e7e419eae51aece51befe51cf1e51df4e61e"
    "f6e620f8e621fbe723fde725";

constexpr double from_hex(char digit) {
  return digit <= '9' ? digit - '0' : digit - 'a' + 10;
}

Color viridis_entry(std::size_t index) {
  Color color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t at = 6 * index + 2 * c;
    color[c] = (16.0 * from_hex(kViridis[at]) + from_hex(kViridis[at + 1])) / 255.0;
  }
  return color;
}

Color viridis(double share) {
  constexpr std::size_t kLast = kViridis.size() / 6 - 1;
  const double place = share * static_cast<double>(kLast);
  const std::size_t low = std::min(static_cast<std::size_t>(place), kLast - 1);
  const double weight = place - static_cast<double>(low);
  const Color a = viridis_entry(low);
  const Color b = viridis_entry(low + 1);
  return {a[0] + weight * (b[0] - a[0]), a[1] + weight * (b[1] - a[1]),
          a[2] + weight * (b[2] - a[2])};
}

double linear_of(double component) {
  return component <= 0.04045 ? component / 12.92 : std::pow((component + 0.055) / 1.055, 2.4);
}
double screen_of(double component) {
  return component <= 0.0031308 ? component * 12.92
                                : 1.055 * std::pow(component, 1.0 / 2.4) - 0.055;
}

/// CIE XYZ of white, as D65 has it, and Lab's curve.
constexpr std::array<double, 3> kWhite{0.95047, 1.0, 1.08883};

double lab_curve(double t) {
  return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
}
double lab_curve_inverse(double f) {
  return f > 6.0 / 29.0 ? f * f * f : (116.0 * f - 16.0) * 27.0 / 24389.0;
}

/// Moreland's Msh: Lab in polar coordinates about black: size, angle from the axis, hue.
Color msh_of(const Color& screen) {
  const Color rgb = to_linear(screen);
  const double x = 0.4124564 * rgb[0] + 0.3575761 * rgb[1] + 0.1804375 * rgb[2];
  const double y = 0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2];
  const double z = 0.0193339 * rgb[0] + 0.1191920 * rgb[1] + 0.9503041 * rgb[2];
  const double fx = lab_curve(x / kWhite[0]);
  const double fy = lab_curve(y / kWhite[1]);
  const double fz = lab_curve(z / kWhite[2]);
  const double l = 116.0 * fy - 16.0;
  const double a = 500.0 * (fx - fy);
  const double b = 200.0 * (fy - fz);
  const double size = std::sqrt(l * l + a * a + b * b);
  return {size, std::acos(l / size), std::atan2(b, a)};
}

Color screen_of_msh(const Color& msh) {
  const double l = msh[0] * std::cos(msh[1]);
  const double a = msh[0] * std::sin(msh[1]) * std::cos(msh[2]);
  const double b = msh[0] * std::sin(msh[1]) * std::sin(msh[2]);
  const double fy = (l + 16.0) / 116.0;
  const double x = kWhite[0] * lab_curve_inverse(fy + a / 500.0);
  const double y = kWhite[1] * lab_curve_inverse(fy);
  const double z = kWhite[2] * lab_curve_inverse(fy - b / 200.0);
  const Color rgb{3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
                  -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                  0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
  return {std::clamp(screen_of(rgb[0]), 0.0, 1.0), std::clamp(screen_of(rgb[1]), 0.0, 1.0),
          std::clamp(screen_of(rgb[2]), 0.0, 1.0)};
}

/// The hue towards which a saturated colour fades on its way to grey of that size, so that the
/// change looks even; away from purple, which would look like a third colour.
double spun_hue(const Color& msh, double grey_size) {
  if (msh[0] >= grey_size) {
    return msh[2];
  }
  const double spin =
      msh[1] * std::sqrt(grey_size * grey_size - msh[0] * msh[0]) / (msh[0] * std::sin(msh[1]));
  return msh[2] > -1.0471975511965976 ? msh[2] + spin : msh[2] - spin;
}

Color cool_warm(double share) {
  constexpr Color kBlue{0.230, 0.299, 0.754};
  constexpr Color kRed{0.706, 0.016, 0.150};
  constexpr double kLeastGrey = 88.0;
  const Color blue = msh_of(kBlue);
  const Color red = msh_of(kRed);
  const double grey_size = std::max({blue[0], red[0], kLeastGrey});
  const Color& end = share < 0.5 ? blue : red;
  const Color grey{grey_size, 0.0, spun_hue(end, grey_size)};
  const double weight = share < 0.5 ? 2.0 * share : 2.0 - 2.0 * share;
  return screen_of_msh({end[0] + weight * (grey[0] - end[0]), end[1] + weight * (grey[1] - end[1]),
                        end[2] + weight * (grey[2] - end[2])});
}

}  // namespace

Color color_of(ColorMap map, double share) noexcept {
  const double within = share > 0.0 ? std::min(share, 1.0) : 0.0;  // NaN is not above 0
  return map == ColorMap::viridis ? viridis(within) : cool_warm(within);
}

Color to_linear(const Color& color) noexcept {
  return {linear_of(color[0]), linear_of(color[1]), linear_of(color[2])};
}

}  // namespace difmesh
