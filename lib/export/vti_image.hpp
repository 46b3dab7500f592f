#pragma once

#include "export/image_content.hpp"
#include "export/text_sink.hpp"

namespace coordreq {

/// An image as VTK's XML image data (.vti): values at cells, compressed, appended as raw bytes. Every version
/// of VTK and ParaView that is in use reads it. `title`, `axes` and `cut` are field data.
///
/// Source: "VTK File Formats" in The VTK User's Guide, 11th edition.
/// @pre every array is float64
void export_vti(const ImageContent& image, const TextSink& sink);

}  // namespace coordreq
