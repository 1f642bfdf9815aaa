// A whole file in memory.
//
// Read, not mapped: a mapping of a file that another process truncates, or that lies on a server
// that goes away, ends the renderer with SIGBUS, where a read fails with a message. The price:
// about half of the time that a binary PLY takes, most of it for touching fresh memory.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace weft {

class FileBytes {
  public:
    FileBytes(std::unique_ptr<char[]> data, size_t size) : data_(std::move(data)), size_(size) {}
    std::string_view view() const { return {data_.get(), size_}; }

  private:
    std::unique_ptr<char[]> data_;
    size_t size_;
};

/// The bytes of the regular file `path`. Throws InputError, with the system's reason, where it is
/// missing, not readable, or not a regular file.
FileBytes read_file(std::string const& path);

} // namespace weft
