#include "scene/scene_hash.h"

#include <cstring>
#include <span>
#include <type_traits>

#include "base/hash.h"
#include "schema/text.h"

namespace weft::scene {

namespace {

class Hasher {
  public:
    uint64_t hash = 0;

    void add(uint64_t v) { hash = hash64(hash ^ v) + v; }
    void add(std::string_view text) {
        add(text.size());
        add(hash_bytes(text));
    }
    /// Eight bytes at a time: meshes are large.
    void add_bytes(std::span<std::byte const> bytes) {
        add(bytes.size());
        for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
            uint64_t v;
            std::memcpy(&v, bytes.data(), 8);
            add(v);
        }
        uint64_t rest = 0;
        if (!bytes.empty()) std::memcpy(&rest, bytes.data(), bytes.size());
        add(rest);
    }
    template <class T>
    void add_array(std::vector<T> const& values) {
        add_bytes(std::as_bytes(std::span(values)));
    }

    // The functor that `describe` takes.
    template <class T>
    void operator()(std::string_view name, T& value, schema::Attr const&) {
        add(name);
        add_value(value);
    }
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }

  private:
    template <class T>
    void add_value(T const& value) {
        add(schema::TextForm<T>::write(value));
    }
    template <class Kind>
    void add_value(schema::Id<Kind> const& id) {
        add(uint64_t(id.index));
    }
    template <class Kind>
    void add_value(std::vector<schema::Id<Kind>> const& ids) {
        add(ids.size());
        for (auto const& id : ids) add_value(id);
    }
    template <class T>
    void add_value(schema::Input<T> const& input) {
        add(schema::TextForm<schema::Input<T>>::write(input));
        add_value(input.texture);
    }
    void add_value(schema::FileName const& file) {
        add(file.path);
        add(uint64_t(file.resource));
    }
};

template <class T>
void add_object(Hasher& h, T object) {
    h.add(T::info.category);
    h.add(T::info.type);
    object.describe(h);
}
template <class... T>
void add_object(Hasher& h, std::variant<T...> const& object) {
    std::visit([&](auto const& o) { add_object(h, o); }, object);
}

template <class T>
void add_all(Hasher& h, std::vector<T> const& objects) {
    h.add(objects.size());
    for (T const& object : objects) add_object(h, object);
}

void add_mesh(Hasher& h, Mesh const& mesh) {
    h.add_array(mesh.positions);
    h.add_array(mesh.normals);
    h.add_array(mesh.uvs);
    h.add_array(mesh.colors);
    for (VertexAttribute const& a : mesh.attributes) {
        h.add(a.name);
        h.add(uint64_t(a.components));
        h.add_array(a.values);
    }
    h.add_array(mesh.triangles);
}

void add_image(Hasher& h, image::Texture const& image) {
    h.add(uint64_t(image.width) << 32 | uint64_t(image.height));
    if (image.source) return h.add(image.source->contents_hash());
    size_t const size = image.level_count() > 1 ? image.level(1).offset : image.memory_bytes();
    h.add_bytes({image.texels(0), size});
}

} // namespace

uint64_t scene_hash(Scene const& scene) {
    Hasher h;
    add_object(h, scene.contents);
    add_all(h, scene.cameras);
    add_all(h, scene.textures);
    add_all(h, scene.materials);
    add_all(h, scene.layers);
    add_all(h, scene.emissions);
    add_all(h, scene.volumes);
    add_all(h, scene.media);
    add_all(h, scene.shapes);
    add_all(h, scene.instances);
    add_all(h, scene.lights);
    for (auto const& mesh : scene.meshes) add_mesh(h, *mesh);
    for (auto const& image : scene.images) add_image(h, *image);
    for (auto const& set : scene.udims)
        for (UdimTile const& tile : set) h.add(uint64_t(tile.number) << 32 | uint32_t(tile.image));
    return h.hash;
}

} // namespace weft::scene
