// A whole file in memory.
//
// Read, not mapped: a mapping of a file that another process truncates, or that lies on a server
// that goes away, ends the renderer with SIGBUS, where a read fails with a message. Large files go
// to huge pages where the system has them, since faulting in small ones costs more than the copy.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace weft::io {

class FileBytes {
  public:
    struct Free {
        void operator()(char* p) const { std::free(p); }
    };
    using Buffer = std::unique_ptr<char[], Free>;

    FileBytes(Buffer data, size_t size) : data_(std::move(data)), size_(size) {}
    std::string_view view() const { return {data_.get(), size_}; }

  private:
    Buffer data_;
    size_t size_;
};

/// The bytes of the regular file `path`. Throws InputError, with the system's reason, where it is
/// missing, not readable, or not a regular file.
FileBytes read_file(std::string const& path);

} // namespace weft::io
