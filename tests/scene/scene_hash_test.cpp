// The hash of a scene knows all of it: each parameter of each type, and all that files hold.
#include "scene/scene_hash.h"

#include <gtest/gtest.h>

#include "base/match.h"
#include "scene/scene_vectors.h"

namespace weft::scene {
namespace {

/// Changes the parameter number `target`, and tells its name.
struct Mutation {
    int target;
    int next = 0;
    std::string changed = {};

    template <class T>
    void operator()(std::string_view name, T& value, schema::Attr const&) {
        if (next++ != target) return;
        changed = name;
        change(value);
    }
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }

    static void change(bool& v) { v = !v; }
    static void change(int& v) { ++v; }
    static void change(float& v) { v += 1; }
    static void change(std::string& v) { v += "x"; }
    static void change(SharedText& v) { v = v.str() + "x"; }
    static void change(Color& v) { v.g += 1; }
    static void change(Vec2& v) { v.y += 1; }
    static void change(Vec3& v) { v.z += 1; }
    static void change(AnyValue& v) { v.v.x += 1; }
    static void change(schema::ColorStops& v) { v.stops.back().color.b += 1; }
    static void change(Affined& v) { v.origin.y += 1; }
    static void change(FileName& v) { ++v.resource; }
    template <schema::Choice E>
    static void change(E& v) {
        v = E((int(v) + 1) % int(choices(v).size()));
    }
    template <class Kind>
    static void change(schema::Id<Kind>& v) {
        ++v.index;
    }
    template <class Kind>
    static void change(std::vector<schema::Id<Kind>>& v) {
        v.push_back({0});
    }
    template <class T>
    static void change(Input<T>& v) {
        ++v.texture.index;
    }
};

/// The value beside a node, which an Input has where it is not the surface's own.
struct ValueMutation : Mutation {
    template <class T>
    void operator()(std::string_view name, Input<T>& value, schema::Attr const&) {
        if (next++ != target) return;
        changed = name;
        if constexpr (schema::SurfaceDefault<T>)
            change(value);
        else
            change(value.value);
    }
    template <class T>
    void operator()(std::string_view, T&, schema::Attr const&) {
        ++next;
    }
    template <class T>
    void group(T& member) {
        member.describe(*this);
    }
};

template <class T>
struct Alternatives {
    using type = std::variant<T>;
};
template <class... T>
struct Alternatives<std::variant<T...>> {
    using type = std::variant<T...>;
};

/// Calls f(vector of the scene, object of one of its types) for all of them.
template <class F>
void for_each_object_type(F&& f) {
    for_each_vector(kObjectVectors, [&]<class Kind, class T>(ObjectVector<Kind, T> const& v) {
        for_each_type<typename Alternatives<T>::type>([&]<class Object>() { f(v, Object{}); });
    });
}

TEST(SceneHash, KnowsEveryParameter) {
    int parameters = 0;
    auto const expect_all = [&](auto const& vector, auto object, auto mutation) {
        Scene scene;
        (scene.*vector.member).push_back(object);
        uint64_t const before = scene_hash(scene);
        for (;; ++mutation.target) {
            auto other = object;
            mutation.next = 0;
            mutation.changed.clear();
            other.describe(mutation);
            if (mutation.target >= mutation.next) return;
            if (mutation.changed.empty()) continue;
            ++parameters;
            (scene.*vector.member)[0] = other;
            EXPECT_NE(scene_hash(scene), before)
                << mutation.changed << " of " << object.info.category << " " << object.info.type;
        }
    };
    for_each_object_type([&](auto const& vector, auto object) {
        expect_all(vector, object, Mutation{0});
        expect_all(vector, object, ValueMutation{{0}});
    });
    EXPECT_GT(parameters, 500);
}

TEST(SceneHash, KnowsEveryVectorOfObjects) {
    for_each_object_type([](auto const& vector, auto object) {
        Scene scene;
        uint64_t const empty = scene_hash(scene);
        (scene.*vector.member).push_back(object);
        uint64_t const one = scene_hash(scene);
        (scene.*vector.member).push_back(object);
        EXPECT_NE(one, empty) << object.info.category;
        EXPECT_NE(scene_hash(scene), one) << object.info.category;
    });
}

TEST(SceneHash, KnowsWhatStandsDirectlyInTheScene) {
    Scene scene;
    uint64_t const before = scene_hash(scene);
    scene.contents.lights.push_back({0});
    EXPECT_NE(scene_hash(scene), before);
}

/// The hash of a scene with these files.
template <class T>
uint64_t hash_with(std::vector<T> Scene::*member, std::vector<T> files) {
    Scene scene;
    scene.*member = std::move(files);
    return scene_hash(scene);
}
template <class T>
uint64_t hash_with(std::vector<std::shared_ptr<T const>> Scene::*member, T const& file) {
    return hash_with(member, std::vector{std::make_shared<T const>(file)});
}

TEST(SceneHash, KnowsWhatFilesHold) {
    uint64_t const empty = scene_hash({});
    Photometry lamp{{0, 90}, {0}, {100, 50}, 1000, 10};
    uint64_t const of_lamp = hash_with(&Scene::photometries, lamp);
    EXPECT_NE(of_lamp, empty);
    for (float Photometry::*number : {&Photometry::lamp_lumens, &Photometry::watts}) {
        Photometry other = lamp;
        other.*number += 1;
        EXPECT_NE(hash_with(&Scene::photometries, other), of_lamp);
    }
    for (auto list : {&Photometry::vertical, &Photometry::horizontal, &Photometry::candela}) {
        Photometry other = lamp;
        (other.*list).back() += 1;
        EXPECT_NE(hash_with(&Scene::photometries, other), of_lamp);
    }

    Mesh mesh;
    mesh.positions = mesh.normals = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
    mesh.colors = {Color(0), Color(0.5f), Color(1)};
    mesh.attributes = {{"mask", 1, {0, 1, 2}}};
    mesh.triangles = {{{0, 1, 2}}};
    uint64_t const of_mesh = hash_with(&Scene::meshes, mesh);
    EXPECT_NE(of_mesh, empty);
    std::vector<void (*)(Mesh&)> const changes{[](Mesh& m) { m.positions[1].x = 2; },
                                               [](Mesh& m) { m.normals[1].x = -1; },
                                               [](Mesh& m) { m.uvs[2].x = 0.5f; },
                                               [](Mesh& m) { m.colors[0].b = 1; },
                                               [](Mesh& m) { m.attributes[0].values[0] = 1; },
                                               [](Mesh& m) { m.attributes[0].name = "m"; },
                                               [](Mesh& m) { m.triangles[0].v[0] = 1; }};
    for (size_t i = 0; i < changes.size(); ++i) {
        Mesh other = mesh;
        changes[i](other);
        EXPECT_NE(hash_with(&Scene::meshes, other), of_mesh) << i;
    }

    auto const picture = [](std::byte texel) {
        return image::Texture::in_memory({image::TexelType::u8, 1}, 2, 1, {texel, std::byte(7)});
    };
    uint64_t const of_picture = hash_with(&Scene::images, picture(std::byte(1)));
    EXPECT_NE(of_picture, empty);
    EXPECT_NE(hash_with(&Scene::images, picture(std::byte(2))), of_picture);

    uint64_t const of_tiles = hash_with(&Scene::udims, {{{1001, 0}, {1002, 1}}});
    EXPECT_NE(of_tiles, empty);
    EXPECT_NE(hash_with(&Scene::udims, {{{1001, 0}, {1003, 1}}}), of_tiles);
    EXPECT_NE(hash_with(&Scene::udims, {{{1001, 0}}, {{1002, 1}}}), of_tiles) << "two sets";
}

TEST(SceneHash, IsDeafToPlacesAndNames) {
    Scene a;
    a.instances.resize(1);
    Scene b = a;
    b.instance_locations = {{"other.xml", 3, 4}};
    b.instance_names = {"hero"};
    EXPECT_EQ(scene_hash(a), scene_hash(b));
}

} // namespace
} // namespace weft::scene
