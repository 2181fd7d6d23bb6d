#include "progress_bar.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

namespace difmesh::cli {
namespace {

constexpr double kSilentSeconds = 1.0;
constexpr double kSecondsBetween = 0.1;
constexpr int kLongestBar = 40;
constexpr int kShortestBar = 8;

std::string padded(const std::string& text, std::size_t width) {
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

}  // namespace

ProgressBar::ProgressBar(std::ostream& out, std::string label, int columns, Clock clock)
    : out_(out),
      label_(std::move(label)),
      columns_(columns),
      clock_(std::move(clock)),
      start_(clock_()),
      last_drawn_(start_ + kSilentSeconds - kSecondsBetween) {}

ProgressBar::~ProgressBar() {
  erase();
}

void ProgressBar::update(double share) {
  const double now = clock_();
  if (now - last_drawn_ < kSecondsBetween) {
    return;
  }
  last_drawn_ = now;
  const std::string text = line(std::clamp(share, 0.0, 1.0), now - start_);
  const std::size_t leftover = drawn_ > text.size() ? drawn_ - text.size() : 0;
  out_ << '\r' << text << std::string(leftover, ' ') << std::flush;
  drawn_ = std::max(drawn_, text.size());
}

void ProgressBar::erase() {
  if (drawn_ > 0) {
    out_ << '\r' << std::string(drawn_, ' ') << '\r' << std::flush;
    drawn_ = 0;
  }
}

std::string ProgressBar::line(double share, double seconds) const {
  // The last column stays free: some terminals go to the next line when it is written.
  const int room = std::max(columns_ - 1, 0);
  const std::string tail = padded(std::to_string(static_cast<int>(100.0 * share)), 3) + " %  " +
                           std::to_string(static_cast<long>(seconds)) + " s";
  std::string text = label_ + " ";
  const int bar = std::min(
      kLongestBar, room - static_cast<int>(label_.size()) - static_cast<int>(tail.size()) - 4);
  if (bar >= kShortestBar) {
    const auto full = static_cast<std::size_t>(share * bar);
    text += '[' + std::string(full, '#');
    text += std::string(static_cast<std::size_t>(bar) - full, '.') + "] ";
  }
  return (text + tail).substr(0, static_cast<std::size_t>(room));
}

}  // namespace difmesh::cli
