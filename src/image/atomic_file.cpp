#include "image/atomic_file.h"

#include "image/image.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace weft::image {

namespace {

namespace fs = std::filesystem;

/// More than there ever are writers of one target at once.
constexpr int kMostWriters = 1000;

std::string temporary_path(std::string const& path, int number) {
    fs::path const target(path);
    fs::path const name = "." + target.stem().string() + ".part-" + std::to_string(number) +
                          target.extension().string();
    return (target.parent_path() / name).string();
}

[[noreturn]] void fail(std::string const& path, char const* what) {
    throw IoError(path + ": " + what + ": " + std::strerror(errno));
}

/// Whether `path` is the name of the regular file that is open.
bool is_name_of(int descriptor, std::string const& path) {
    struct stat open = {}, named = {};
    return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
           S_ISREG(named.st_mode) && open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/// Removes the file of a writer that was killed. Not that of a living one, which has it locked.
bool remove_stale(std::string const& path) {
    int const descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return false;
    bool const removed = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 &&
                         is_name_of(descriptor, path) && ::unlink(path.c_str()) == 0;
    ::close(descriptor);
    return removed;
}

/// A new file of this name, locked until it is closed; -1 with errno EEXIST where another writer
/// has the name. Where the file system knows no locks, the file has none, and none is ever stale.
int make_locked(std::string const& path) {
    auto const make = [&] {
        return ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    };
    int descriptor = make();
    if (descriptor < 0 && errno != EEXIST) return -1;
    if (descriptor < 0 && remove_stale(path)) descriptor = make();
    errno = EEXIST;
    if (descriptor < 0) return -1;
    // Before it was locked, somebody may have taken it for stale.
    bool const lost = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!lost && is_name_of(descriptor, path)) return descriptor;
    ::close(descriptor);
    errno = EEXIST;
    return -1;
}

/// A temporary file, closed and removed on every way out that does not keep it. Its name is the
/// first that no living writer of the target has, so that what a killed one left goes with the next
/// write.
class Temporary {
  public:
    explicit Temporary(std::string const& target) {
        for (int number = 0; descriptor_ < 0 && number < kMostWriters; ++number) {
            path_ = temporary_path(target, number);
            descriptor_ = make_locked(path_);
            if (descriptor_ < 0 && errno != EEXIST) break;
        }
        if (descriptor_ < 0) fail(target, "cannot make a file in its folder");
    }
    Temporary(Temporary const&) = delete;
    Temporary& operator=(Temporary const&) = delete;
    ~Temporary() {
        // While it is locked: after that the name may be another writer's.
        if (!kept_) ::unlink(path_.c_str());
        ::close(descriptor_);
    }
    std::string const& path() const { return path_; }
    int descriptor() const { return descriptor_; }
    /// False, with errno set, where the file cannot take the name `target`.
    bool keep_as(std::string const& target) {
        // Some network file systems tell of a full disk when a file is closed. The lock stays with
        // the other descriptor until the file has its name.
        int const second = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
        bool const closed = second >= 0 && ::close(second) == 0;
        kept_ = closed && ::rename(path_.c_str(), target.c_str()) == 0;
        return kept_;
    }

  private:
    std::string path_;
    int descriptor_ = -1;
    bool kept_ = false;
};

/// Makes a new name durable. Some network file systems refuse, and the file is whole anyway.
void flush_folder(std::string const& path) {
    fs::path const folder = fs::path(path).parent_path();
    int const descriptor =
        ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

} // namespace

void replace_file(std::string const& path,
                  std::function<void(int, std::string const&)> const& fill) {
    Temporary temporary(path);
    // The new file keeps the permissions of the one it replaces, where the user may set them.
    struct stat old = {};
    if (::stat(path.c_str(), &old) == 0)
        (void)::fchmod(temporary.descriptor(), old.st_mode & 07777);
    fill(temporary.descriptor(), temporary.path());
    // Without this a crash soon after the rename could leave an empty file under the old name.
    if (::fsync(temporary.descriptor()) != 0) fail(path, "cannot write to the disk");
    if (!temporary.keep_as(path)) fail(path, "cannot replace the file");
    flush_folder(path);
}

void replace_file(std::string const& path, std::string_view contents) {
    replace_file(path, [&](int descriptor, std::string const&) {
        for (size_t at = 0; at < contents.size();) {
            ssize_t const n = ::write(descriptor, contents.data() + at, contents.size() - at);
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) fail(path, "cannot write");
            at += size_t(n);
        }
    });
}

void probe_folder(std::string const& path) { Temporary const temporary(path); }

} // namespace weft::image
