#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "results/rank_chunks.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Writes the results file of contract section 4. The file appears whole or not at all: it is written beside
/// `path`, synced and renamed; an existing file is replaced only on success. The bytes depend neither on the
/// number of threads nor on the run. Chunks are compressed in parallel and written directly.
///
/// Where `path` is a symbolic link, the file that it points to is replaced and the link stays. Written is
/// what result_fields() declares for the spec. Memory: about 7 MiB a thread.
/// @param ranks who knows arrays of cells, if there are several processes, which then call this together;
///   the first of them writes the file. Null: there is one
/// @throws std::invalid_argument if a field has no values, or ones of a type that it does not have;
///   IoError naming the path if the folder is missing or not writable, the disk is full, or `path` is a
///   folder, a device or a pipe; what a FillArray throws, with nothing left behind
void write_results(const std::string& path, const ProblemSpec& spec, const FieldValues& values,
                   ThreadTeam& team, RankChunks* ranks = nullptr);

/// A kind of file: its label, for errors, and its first two attributes.
struct FileKind {
  std::string label;
  std::string filetype;
  std::array<std::int32_t, 2> version;
};
/// Any file of fields, by the same rules: its attributes, the text of the spec, and fields in their order.
void write_fields(const std::string& path, const FileKind& kind,
                  const std::vector<FieldAttribute>& attributes, const ProblemSpec& spec,
                  const Fields& fields, const FieldValues& values, ThreadTeam& team,
                  RankChunks* ranks = nullptr);

/// Memory of write_results(), in bytes. @param longest bytes of the longest field, before it is packed
[[nodiscard]] double write_results_bytes(const ProblemSpec& spec, double longest, int threads);

/// @throws IoError as write_results() would for reasons that are known before the work starts, so that a long
///   analysis does not fail at its end. Leaves nothing behind.
void check_writable(const std::string& path);

/// The attributes of a results file itself, but for `version`; what describes the program is marked as found.
[[nodiscard]] std::vector<FieldAttribute> header_attributes(const ProblemSpec& spec);

}  // namespace coordreq
