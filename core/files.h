// Files appear whole or not at all: written beside, flushed to disk, renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace fathom {

/// When a file reaches the disk: before it gets its name, so that a power cut leaves the old file or the new one; or
/// later, with flush_file_system() for all of them, which is quicker for many small files.
enum class Flush { at_once, later };

/// Calls `write` with a temporary path in the same folder, flushes it to disk, unless later, and renames it to `path`.
/// When `write` throws, the temporary file is removed and `path` is untouched. Throws Error if `path` cannot be
/// written.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& beside)>& write,
                      Flush flush = Flush::at_once);

/// Waits until all that was written to the folder's file system is on the disk. Throws Error when it cannot be.
void flush_file_system(const std::filesystem::path& folder);

/// Removes the temporary files of write_atomically() whose process is gone from a folder, and no others. For the
/// folder's owner (core/folder_owner.h).
void remove_leftovers(const std::filesystem::path& folder);

void write_text(const std::filesystem::path& path, std::string_view text, Flush flush = Flush::at_once);

/// The whole file. Throws Error, at once, when it is missing, no regular file, unreadable or beyond the InputPolicy.
std::string read_text(const std::filesystem::path& path);

/// Creates the directory (and its parents). Throws Error when it cannot, or when a file stands in its place.
void make_directory(const std::filesystem::path& path);

/// Folder of the libraries that come with the program (`scenes/`): $FATHOM_DATA, the installed share directory or the
/// source tree, the first that exists. Throws Error when there is none.
std::filesystem::path data_directory();

/// Whether the first 1,000 bytes of a file hold these words, by which ours is known.
bool is_ours(const std::filesystem::path& file, std::string_view words);
/// Removes a file that is.
void remove_if_ours(const std::filesystem::path& file, std::string_view words);

}  // namespace fathom
