// The bytes of a glTF 2.0 file (Khronos 2021, "glTF 2.0 Specification", sections 3.6 and 4.4):
// text or binary container, buffers, buffer views, and accessors as plain arrays.
//
// Every offset, stride and count is checked before use, and memory stays within a small multiple
// of the file's own size, whatever it claims.
#pragma once

#include <memory>

#include "base/file_bytes.h"
#include "io/gltf_json.h"

namespace weft::io::gltf {

/// Numbers of an accessor: count elements of `components` numbers, normalised integers as reals.
struct Floats {
    size_t count = 0, components = 0;
    std::vector<float> data;
};

class File {
  public:
    /// `bytes` is the whole file; buffers and images that it names are looked for in `folder`.
    /// Throws InputError for a broken container, malformed JSON, a version other than 2.x.
    File(std::string_view bytes, std::string const& name, std::string folder);
    File(File const&) = delete;
    File& operator=(File const&) = delete;

    Report& report() { return report_; }
    Object& root() { return *root_; }
    Json const& json() const { return json_; }
    /// The elements of a top-level array such as "nodes"; `count` of one that is absent is 0.
    size_t count(char const* list) const;
    Object element(char const* list, size_t index);

    /// The numbers of an accessor whose type is one of `types` ("VEC3", ...), read once.
    Floats const& floats(size_t accessor, std::vector<std::string> const& types);
    /// The unsigned integers of a scalar accessor.
    std::vector<uint32_t> integers(size_t accessor);

    /// The bytes of a buffer view, without regard to its stride.
    std::string_view view_bytes(size_t view);

    /// What a URI stands for: the decoded bytes of a `data:` URI (then `path` is ""), or the path
    /// of a file that exists. Throws InputError at `where`.
    struct Resource {
        std::string data, path;
    };
    Resource resolve(std::string const& uri, std::string const& where) const;

  private:
    struct View {
        std::string_view bytes;
        size_t stride; ///< 0: tightly packed
    };
    struct Accessor {
        std::string path;
        size_t count, components, component_size;
        int component_type;
        bool normalized;
        size_t element_size() const { return components * component_size; }
    };
    struct Buffer {
        bool loaded = false;
        std::string owned;
        std::optional<FileBytes> file;
        std::string_view bytes;
    };

    void open_container(std::string_view bytes);
    std::string_view buffer(size_t index);
    View view(size_t index);
    Accessor shape_of(Object& accessor);
    /// Calls read(i, address) for every element that the accessor's view holds.
    template <class Read>
    void for_each(Accessor const& a, Object& accessor, Read&& read);
    template <class Read>
    void for_each_sparse(Accessor const& a, Object& accessor, Read&& read);
    template <class Read>
    void scan(Accessor const& a, View const& view, size_t offset, std::string const& path,
              Read&& read);

    Report report_;
    std::string folder_;
    Json json_;
    std::optional<Object> root_;
    std::string_view binary_; ///< the container's BIN chunk
    bool has_binary_ = false;
    size_t file_size_ = 0;
    std::vector<Buffer> buffers_;
    std::map<size_t, Floats> floats_;
};

} // namespace weft::io::gltf
