#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace coordreq {

/// The attributes and axes of an object of a results file, as stored.
struct StoredObject {
  std::string path;
  std::map<std::string, std::string> texts;  ///< attributes that are strings
  std::map<std::string, std::vector<std::int64_t>>
      integers;                                        ///< attributes that are integers, or lists of them
  std::map<std::string, std::vector<double>> numbers;  ///< the same with floating point
  std::vector<std::string>
      axes;                ///< paths of the dimension scales, one an axis; none if it is a scale itself
  bool is_scale = false;   ///< gives others their axis
  std::string scale_name;  ///< what a scale calls itself
  bool is_blank = true;    ///< a scale that is no more than a length has no element but 0
};

/// Reads the objects at these paths, in a child process first (see try_in_child()).
/// @throws IoError, ResultsError as ResultsReader does
[[nodiscard]] std::vector<StoredObject> read_objects(const std::string& file,
                                                     const std::vector<std::string>& paths);

}  // namespace coordreq
