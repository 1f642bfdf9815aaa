#include "image/atomic_file.h"

#include "image/image.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace weft::image {

namespace {

namespace fs = std::filesystem;

/// A path that no other process or thread of this machine makes up at the same time.
std::string temporary_path(std::string const& path) {
    static std::atomic<unsigned> counter = 0;
    fs::path const target(path);
    std::string const unique = std::to_string(::getpid()) + "-" + std::to_string(counter++);
    fs::path const name =
        "." + target.stem().string() + ".part-" + unique + target.extension().string();
    return (target.parent_path() / name).string();
}

[[noreturn]] void fail(std::string const& path, char const* what) {
    throw IoError(path + ": " + what + ": " + std::strerror(errno));
}

/// A temporary file, closed and removed on every way out that does not keep it.
class Temporary {
  public:
    explicit Temporary(std::string const& target)
        : path_(temporary_path(target)),
          descriptor_(::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
        if (descriptor_ < 0) fail(target, "cannot make a file in its folder");
    }
    Temporary(Temporary const&) = delete;
    Temporary& operator=(Temporary const&) = delete;
    ~Temporary() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!kept_) ::unlink(path_.c_str());
    }
    std::string const& path() const { return path_; }
    int descriptor() const { return descriptor_; }
    /// False, with errno set, where the file cannot take the name `target`.
    bool keep_as(std::string const& target) {
        // Some network file systems tell of a full disk when a file is closed.
        bool const closed = ::close(descriptor_) == 0;
        descriptor_ = -1;
        kept_ = closed && ::rename(path_.c_str(), target.c_str()) == 0;
        return kept_;
    }

  private:
    std::string path_;
    int descriptor_;
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

void probe_folder(std::string const& path) { Temporary const temporary(path); }

} // namespace weft::image
