#pragma once
/// \file progress_bar.hpp
/// A line on a terminal that shows how far long work has come.

#include <functional>
#include <iosfwd>
#include <string>

namespace difmesh::cli {

/// Draws on one line and takes it away again, with carriage returns and blanks only. Nothing is
/// drawn in the first second: short work leaves no flicker.
class ProgressBar {
 public:
  using Clock = std::function<double()>;  ///< seconds, never decreasing

  /// \param columns of the terminal; \param clock the time starts now
  ProgressBar(std::ostream& out, std::string label, int columns, Clock clock);
  /// Takes the line away.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// \param share of the work done, in [0,1]. Draws at most ten times a second.
  void update(double share);
  /// Takes the line away; the next update() may draw it again.
  void erase();

 private:
  [[nodiscard]] std::string line(double share, double seconds) const;

  std::ostream& out_;
  std::string label_;
  int columns_;
  Clock clock_;
  double start_;
  double last_drawn_;
  std::size_t drawn_ = 0;  ///< characters on the line
};

}  // namespace difmesh::cli
