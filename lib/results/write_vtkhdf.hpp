#pragma once

#include <string>

#include "base/thread_team.hpp"
#include "results/image_content.hpp"

namespace coordreq {

/// Writes a VTKHDF file that holds image data with values at its cells. The file appears whole or not at all;
/// equal contents give equal bytes, for any number of threads.
///
/// The reader of VTK 9.1 takes arrays at cells for as large as arrays at points and crashes; export_vti()
/// writes what it can read.
///
/// Source: "VTKHDF File Format", VTK documentation.
/// REQUIRES: less than 2^31 cells along each axis.
/// @throws IoError naming `path`
void write_vtkhdf(const std::string& path, const ImageContent& content, ThreadTeam& team);

}  // namespace coordreq
