#pragma once

#include <functional>
#include <string>

namespace coordreq {

/// Calls `read` in a child process, a copy of this one, and waits for its end.
///
/// HDF5 1.10 trusts what it finds in a file: in a damaged one the list entry of a variable-length string, the
/// heap it points to or an object header can make the library write beyond its buffers or crash. There is no
/// way to check that from outside. So whatever reads strings, lists and structure of a file is tried in a
/// child first, and done again here only where it went well: the library then does exactly the same.
///
/// The child ends without a clock: it may use processor time in proportion to the file, so that a busy or
/// slow machine only takes longer; and it can open nothing but the file, so that nothing keeps it waiting.
///
/// @pre unchecked: `read` starts no thread, writes nothing, and has one file open at a time.
/// @param path of the file that is read
/// @throws what `read` threw in the child if that is an Error (IoError, ResultsError, or an Error with the
///   same exit code and text); ResultsError if the child came to another end; IoError if there can be no
///   child
void try_in_child(const std::string& path, const std::function<void()>& read);

}  // namespace coordreq
