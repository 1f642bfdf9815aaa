#include "scene/scene_hash.h"

#include <cstring>
#include <span>
#include <type_traits>

#include "base/hash.h"
#include "scene/scene_vectors.h"
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
void add_object(Hasher& h, T const& object) {
    h.add(T::info.category);
    h.add(T::info.type);
    schema::read_members(object, h);
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

// One overload for each type of resource: a new one that has none does not compile.

void add_resource(Hasher& h, std::shared_ptr<Mesh const> const& mesh) {
    h.add_array(mesh->positions);
    h.add_array(mesh->normals);
    h.add_array(mesh->uvs);
    h.add_array(mesh->colors);
    h.add(mesh->attributes.size());
    for (VertexAttribute const& a : mesh->attributes) {
        h.add(a.name);
        h.add(uint64_t(a.components));
        h.add_array(a.values);
    }
    h.add_array(mesh->triangles);
}

void add_resource(Hasher& h, std::shared_ptr<image::Texture const> const& image) {
    h.add(uint64_t(image->width) << 32 | uint64_t(image->height));
    if (image->source) return h.add(image->source->contents_hash());
    size_t const size = image->level_count() > 1 ? image->level(1).offset : image->memory_bytes();
    h.add_bytes({image->texels(0), size});
}

void add_resource(Hasher& h, std::shared_ptr<Photometry const> const& lamp) {
    h.add_array(lamp->vertical);
    h.add_array(lamp->horizontal);
    h.add_array(lamp->candela);
    h.add_array(std::vector{lamp->lamp_lumens, lamp->watts});
}

void add_resource(Hasher& h, std::vector<UdimTile> const& tiles) {
    h.add(tiles.size());
    for (UdimTile const& tile : tiles) h.add(uint64_t(tile.number) << 32 | uint32_t(tile.image));
}

} // namespace

uint64_t scene_hash(Scene const& scene) {
    Hasher h;
    add_object(h, scene.contents);
    for_each_vector(kObjectVectors, [&](auto const& v) { add_all(h, scene.*v.member); });
    for_each_vector(kResourceVectors, [&](auto member) {
        h.add((scene.*member).size());
        for (auto const& resource : scene.*member) add_resource(h, resource);
    });
    return h.hash;
}

} // namespace weft::scene
