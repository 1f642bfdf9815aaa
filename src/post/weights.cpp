#include "post/weights.h"

#include <half.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "base/error.h"

namespace weft::post {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little);

namespace {

class Reader {
  public:
    Reader(std::string_view bytes, std::string const& name) : bytes_(bytes), name_(name) {}

    template <class T>
    T read() {
        T value;
        std::memcpy(&value, take(sizeof(T)), sizeof(T));
        return value;
    }
    std::string text(size_t length) {
        char const* from = take(length);
        return {from, length};
    }
    void seek(uint64_t offset) {
        if (offset > bytes_.size())
            fail("expected an offset in the file, found one beyond its end");
        at_ = size_t(offset);
    }
    char const* take(size_t count) {
        if (count > bytes_.size() - at_) fail("the file ends too early");
        at_ += count;
        return bytes_.data() + (at_ - count);
    }
    size_t position() const { return at_; }
    [[noreturn]] void fail(std::string const& what) const {
        throw InputError({name_}, "expected weights of a network (.tza): " + what);
    }

  private:
    std::string_view bytes_;
    std::string const& name_;
    size_t at_ = 0;
};

Tensor read_tensor(Reader& in) {
    constexpr uint64_t kMost = 1 << 28; // values; the largest published network has 4 million
    Tensor tensor;
    int const rank = in.read<uint8_t>();
    uint64_t count = 1;
    for (int i = 0; i < rank; ++i) {
        uint64_t const size = in.read<uint32_t>();
        if (size == 0 || size > kMost / count) in.fail("expected a tensor of sensible size");
        count *= size;
        tensor.dims.push_back(int64_t(size));
    }
    std::string const layout = in.text(size_t(rank));
    if (layout != "x" && layout != "oihw") in.fail("unknown layout '" + layout + "'");
    char const type = in.read<char>();
    uint64_t const offset = in.read<uint64_t>();
    size_t const back = in.position();
    in.seek(offset);
    if (type == 'f') {
        char const* from = in.take(count * sizeof(float));
        tensor.values.resize(size_t(count));
        std::memcpy(tensor.values.data(), from, count * sizeof(float));
    } else if (type == 'h') {
        char const* from = in.take(count * sizeof(uint16_t));
        tensor.values.resize(size_t(count));
        for (float& value : tensor.values) {
            uint16_t bits;
            std::memcpy(&bits, from, sizeof(bits));
            value = imath_half_to_float(bits);
            from += sizeof(bits);
        }
    } else {
        in.fail("unknown type of number");
    }
    in.seek(back);
    return tensor;
}

} // namespace

Weights parse_weights(std::string_view bytes, std::string const& name) {
    Reader in(bytes, name);
    if (in.read<uint16_t>() != 0x41d7) in.fail("the file begins otherwise");
    int const major = in.read<uint8_t>();
    in.read<uint8_t>();
    if (major != 2) in.fail("expected version 2 of the format, found " + std::to_string(major));
    in.seek(in.read<uint64_t>());
    uint32_t const count = in.read<uint32_t>();
    Weights weights;
    for (uint32_t i = 0; i < count; ++i) {
        uint16_t const length = in.read<uint16_t>();
        std::string const tensor_name = in.text(length);
        weights[tensor_name] = read_tensor(in);
    }
    return weights;
}

Weights read_weights(std::string const& path) {
    std::ifstream file(path, std::ios::binary);
    std::string const bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw InputError({path}, "cannot read the weights of the network");
    return parse_weights(bytes, path);
}

std::vector<std::string> weight_folders(std::string const& first) {
    std::vector<std::string> folders;
    auto variable = [](char const* name) {
        char const* value = std::getenv(name);
        return fs::path(value ? value : "");
    };
    if (!first.empty()) folders.push_back(first);
    if (auto const own = variable("WEFT_WEIGHTS"); !own.empty()) folders.push_back(own.string());
    if (auto const data = variable("XDG_DATA_HOME"); !data.empty())
        folders.push_back((data / "weft/weights").string());
    else if (auto const home = variable("HOME"); !home.empty())
        folders.push_back((home / ".local/share/weft/weights").string());
    std::error_code error;
    fs::path const program = fs::read_symlink("/proc/self/exe", error);
    if (!error)
        folders.push_back((program.parent_path().parent_path() / "share/weft/weights").string());
    fs::path const named = variable("XDG_DATA_DIRS");
    std::istringstream shared(named.empty() ? "/usr/local/share:/usr/share" : named.string());
    for (std::string folder; std::getline(shared, folder, ':');)
        if (!folder.empty()) folders.push_back((fs::path(folder) / "weft/weights").string());
    return folders;
}

std::string find_weights(std::string const& file, std::vector<std::string> const& folders) {
    for (std::string const& folder : folders) {
        std::error_code error;
        fs::path const path = fs::path(folder) / file;
        if (fs::is_regular_file(path, error)) return path.string();
    }
    return "";
}

} // namespace weft::post
