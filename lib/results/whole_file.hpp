#pragma once

#include <functional>
#include <string>

namespace coordreq {

/// Makes a file that appears whole or not at all (OutputFile): `write` fills the temporary one, whose path it
/// is given.
/// @param what the content in words, for messages: "the results"
/// @throws IoError naming `path` where `write` throws an hdf5::Failure or the file cannot be made; else what
///   `write` throws
void write_whole_file(const std::string& path, const std::string& what,
                      const std::function<void(const std::string& temporary)>& write);

}  // namespace coordreq
