#pragma once
/// \file omissions.hpp
/// What a reader leaves out, in one warning for each kind.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace difmesh::detail {

class Omissions {
 public:
  /// \param place the first of a kind is named
  /// \param what follows it in the sentence, and tells the kinds apart; not the file's own words,
  ///   of which there may be many
  void note(const std::string& place, const std::string& what);
  void add_to(std::vector<std::string>& warnings, const std::filesystem::path& path) const;

 private:
  struct Kind {
    std::string place;
    std::string what;
    std::size_t others = 0;
  };
  std::vector<Kind> kinds_;
};

}  // namespace difmesh::detail
