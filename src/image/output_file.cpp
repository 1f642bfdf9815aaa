#include "image/output_file.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include <unistd.h>

#include "image/atomic_file.h"
#include "image/image.h"

namespace weft::image {

namespace {

/// A file that the format libraries believe never fails. Told of an error, the JPEG library ends
/// the process and the EXR library, which writes its tables while it closes, says nothing; so they
/// are not told, and the first error is asked for at the end.
class PatientFile : public OIIO::Filesystem::IOProxy {
  public:
    PatientFile(int descriptor, std::string const& path)
        : IOProxy(path, Write), descriptor_(descriptor) {}
    /// Not "file": that name has OpenImageIO cast to its own type.
    char const* proxytype() const override { return "patient"; }
    size_t write(void const* data, size_t size) override {
        pwrite(data, size, m_pos);
        m_pos += int64_t(size);
        return size;
    }
    size_t pwrite(void const* data, size_t size, int64_t offset) override {
        auto const* bytes = static_cast<char const*>(data);
        size_ = std::max(size_, size_t(offset) + size);
        for (size_t done = 0; done < size && reason_ == 0;) {
            ssize_t const n =
                ::pwrite(descriptor_, bytes + done, size - done, off_t(offset) + off_t(done));
            if (n >= 0)
                done += size_t(n);
            else if (errno != EINTR)
                reason_ = errno;
        }
        return size;
    }
    size_t read(void* data, size_t size) override {
        size_t const n = pread(data, size, m_pos);
        m_pos += int64_t(n);
        return n;
    }
    size_t pread(void* data, size_t size, int64_t offset) override {
        ssize_t const n = ::pread(descriptor_, data, size, off_t(offset));
        return n < 0 ? 0 : size_t(n);
    }
    size_t size() const override { return size_; }
    int reason() const { return reason_; } ///< errno of the first failure, or 0

  private:
    int descriptor_;
    size_t size_ = 0;
    int reason_ = 0;
};

} // namespace

void write_file(std::string const& path, std::string const& format, FillOutput const& fill,
                bool in_parts) {
    replace_file(path, [&](int descriptor, std::string const& temporary) {
        PatientFile file(descriptor, temporary);
        auto const output = OIIO::ImageOutput::create(format.empty() ? temporary : format);
        if (!output) throw IoError(path + ": cannot write the image: " + OIIO::geterror());
        bool const by_name = in_parts && std::string_view(output->format_name()) == "tiff";
        bool const filled = (by_name || output->set_ioproxy(&file)) && fill(*output, temporary);
        bool const closed = output->close();
        if (file.reason() != 0)
            throw IoError(path + ": cannot write the image: " + std::strerror(file.reason()));
        if (!filled || !closed)
            throw IoError(path + ": cannot write the image: " + output->geterror());
    });
}

} // namespace weft::image
