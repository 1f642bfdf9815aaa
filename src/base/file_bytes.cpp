#include "base/file_bytes.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace weft {

namespace {

/// Closes a file descriptor on every way out.
struct Descriptor {
    int fd;
    explicit Descriptor(int descriptor) : fd(descriptor) {}
    Descriptor(Descriptor const&) = delete;
    Descriptor& operator=(Descriptor const&) = delete;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

[[noreturn]] void fail(std::string const& path, char const* what) {
    throw InputError({path}, std::string(what) + ": " + std::strerror(errno));
}

} // namespace

FileBytes read_file(std::string const& path) {
    // O_NONBLOCK: opening a pipe that nobody writes to must not wait before it is refused.
    Descriptor const file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.fd < 0) fail(path, "cannot open the file");
    struct stat status = {};
    if (::fstat(file.fd, &status) != 0) fail(path, "cannot open the file");
    if (!S_ISREG(status.st_mode))
        throw InputError({path}, S_ISDIR(status.st_mode) ? "expected a file, found a folder"
                                                         : "expected a regular file");
    size_t const expected = size_t(status.st_size);
    std::unique_ptr<char[]> data(new char[expected]);
    size_t size = 0;
    while (size < expected) {
        ssize_t const n = ::read(file.fd, data.get() + size, expected - size);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail(path, "cannot read the file");
        if (n == 0) break; // it shrank meanwhile; what is missing shows when parsed
        size += size_t(n);
    }
    return {std::move(data), size};
}

} // namespace weft
