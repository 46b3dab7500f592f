#include "export/formats.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <span>

#include "base/requires.hpp"
#include "export/report_page.hpp"
#include "results/chunk_codec.hpp"

namespace coordreq {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says that it is little-endian");

constexpr std::uint64_t kBlockElements = 1 << 17;

/// An array of texts, each as the numbers of its bytes and a 0 at the end, which is how VTK has them.
std::string text_field(const std::string& name, const std::vector<std::string>& texts) {
  std::string bytes;
  for (const std::string& text : texts) {
    for (const char c : text) bytes += std::to_string(static_cast<unsigned char>(c)) + " ";
    bytes += "0 ";
  }
  return fmt::format(
      "      <DataArray type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">{}</DataArray>\n",
      name, texts.size(), bytes);
}

void append_number(std::string& bytes, std::uint64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Number of blocks, their size, that of the last one, sizes of the packed ones; then these.
std::string packed(const ResultArray& array, std::uint64_t elements) {
  const std::uint64_t blocks = (elements + kBlockElements - 1) / kBlockElements;
  std::string head, body;
  append_number(head, blocks);
  append_number(head, kBlockElements * sizeof(double));
  append_number(head, elements % kBlockElements * sizeof(double));
  ChunkCodec codec;
  std::vector<double> values;
  std::vector<std::byte> block;
  for (std::uint64_t begin = 0; begin < elements; begin += kBlockElements) {
    values.resize(std::min(kBlockElements, elements - begin));
    array.fill(begin, values.size(), values.data());
    codec.pack(std::as_bytes(std::span(values)), 1, block);
    append_number(head, block.size());
    body.append(reinterpret_cast<const char*>(block.data()), block.size());
  }
  return head + body;
}

}  // namespace

void export_vti(const ImageContent& image, const TextSink& sink) {
  REQUIRES(std::ranges::all_of(image.arrays,
                               [](const auto& array) { return array.values.type == ElementType::float64; }));
  const std::uint64_t cells = image.cells[0] * image.cells[1] * image.cells[2];
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", image.cells[0], image.cells[1], image.cells[2]);
  sink(fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n"
      "  <ImageData WholeExtent=\"{}\" Origin=\"{}\" Spacing=\"{}\">\n"
      "    <FieldData>\n{}{}{}    </FieldData>\n"
      "    <Piece Extent=\"{}\">\n      <CellData>\n",
      extent, fmt::join(image.origin, " "), fmt::join(image.spacing, " "), text_field("title", {image.title}),
      text_field("axes", {image.axes.begin(), image.axes.end()}), text_field("cut", {image.cut}), extent));
  std::vector<std::string> data;
  std::uint64_t offset = 0;
  for (const ImageContent::Array& array : image.arrays) {
    sink(fmt::format("        <DataArray type=\"Float64\" Name=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                     html_text(array.name), offset));
    data.push_back(packed(array.values, cells));
    offset += data.back().size();
  }
  sink("      </CellData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_");
  for (const std::string& bytes : data) sink(bytes);
  sink("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace coordreq
