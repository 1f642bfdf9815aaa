#include "world/world_builder.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "scene/check.h"
#include "scene/material_facts.h"

namespace weft::world {

namespace {

/// A mesh of fewer triangles is copied wherever it stands: a level of instancing costs more.
constexpr size_t kInstancingThreshold = 64;

std::shared_ptr<scene::Mesh const> make_rectangle() {
    scene::Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
    return std::make_shared<scene::Mesh const>(std::move(mesh));
}

bool keeps_round(Affined const& m) {
    double const a = length(m.x), b = length(m.y), c = length(m.z), least = 1e-6 * a;
    return std::abs(a - b) < least && std::abs(a - c) < least &&
           std::abs(dot(m.x, m.y)) < least * a && std::abs(dot(m.y, m.z)) < least * a &&
           std::abs(dot(m.z, m.x)) < least * a;
}

/// What a group hides, its members do not show.
scene::RayVisibility all_of(scene::RayVisibility const& a, scene::RayVisibility const& b) {
    return {a.camera && b.camera, a.diffuse && b.diffuse,
            a.glossy && b.glossy, a.transmission && b.transmission,
            a.volume && b.volume, a.shadow && b.shadow};
}

/// The same for the plane z = 0.
bool keeps_circles(Affined const& m) {
    double const a = length(m.x), b = length(m.y), least = 1e-6 * a;
    return std::abs(a - b) < least && std::abs(dot(m.x, m.y)) < least * a;
}

} // namespace

std::unique_ptr<World> World::commit(std::shared_ptr<scene::Scene const> scene,
                                     CommitOptions const& options) {
    scene::check(*scene);
    std::unique_ptr<World> world(new World);
    world->scene_ = scene;
    WorldBuilder(*world, *scene, options).build();
    return world;
}

void WorldBuilder::build() {
    auto const& camera = scene_.cameras[size_t(scene_.contents.camera.index)];
    world_.camera_ = CameraRays(camera, scene_.images);
    if (options_.size.x > 0) world_.camera_.resize(options_.size);
    for (scene::Texture const& node : scene_.textures)
        if (auto const* image = std::get_if<scene::ImageTexture>(&node))
            world_.use_footprints_ |= image->filter == scene::TextureFilter::mipmap;
    rectangle_ = make_rectangle();
    collect_instances();
    mask_objects();
    compile_networks();
    rank_boundaries();
    attach_attributes();
    build_kernel_scene();
    media::Interior space;
    if (scene_.contents.medium) {
        auto const& m = scene_.media[size_t(scene_.contents.medium.index)];
        space.medium = add_medium({m.absorption, m.scatter, m.phase});
    }
    world_.outside_ = media::MediumStack(space);
    count();
}

void WorldBuilder::collect_instances() {
    std::vector<int32_t> roots;
    for (scene::InstanceId id : scene_.contents.instances) roots.push_back(id.index);
    std::map<int32_t, scene::LightId> area_lights; // by instance
    for (scene::LightId id : scene_.contents.lights) {
        auto const* area = std::get_if<scene::AreaLight>(&scene_.lights[size_t(id.index)]);
        if (!area) continue;
        area_lights[area->instance.index] = id;
        // An instance that the scene lists as well is not there twice.
        if (std::find(roots.begin(), roots.end(), area->instance.index) == roots.end())
            roots.push_back(area->instance.index);
    }
    // How often is each mesh used? Groups count their members for every instance of the group.
    std::vector<int32_t> open = roots;
    while (!open.empty()) {
        scene::Instance const& instance = scene_.instances[size_t(open.back())];
        open.pop_back();
        scene::Shape const& shape = scene_.shapes[size_t(instance.shape.index)];
        if (auto const* mesh = std::get_if<scene::MeshShape>(&shape))
            ++mesh_uses_[mesh->filename.resource];
        if (auto const* group = std::get_if<scene::Group>(&shape))
            for (scene::InstanceId id : group->instances) open.push_back(id.index);
    }
    for (int32_t root : roots) {
        size_t const first = world_.objects_.size();
        add_instance(root, {});
        if (auto const it = area_lights.find(root); it != area_lights.end())
            for (size_t i = first; i < world_.objects_.size(); ++i)
                if (world_.objects_[i].emission) add_area_object(uint32_t(i), it->second);
    }
}

void WorldBuilder::add_area_object(uint32_t object, scene::LightId light) {
    auto const& area = std::get<scene::AreaLight>(scene_.lights[size_t(light.index)]);
    world_.objects_[object].spread = shading::Spread(area.spread);
    world_.area_objects_.push_back({object, light});
}

void WorldBuilder::add_instance(int32_t index, Inherited const& outer) {
    scene::Instance const& instance = scene_.instances[size_t(index)];
    scene::Shape const& shape = scene_.shapes[size_t(instance.shape.index)];
    auto pick = [](auto const& from_outer, auto const& own) {
        return from_outer ? from_outer : own;
    };
    Inherited given;
    given.transform = outer.transform * instance.transform;
    given.material = pick(outer.material, instance.bsdf);
    given.emission = pick(outer.emission, instance.emission);
    given.normal_map = pick(outer.normal_map, instance.normal);
    given.volume = pick(outer.volume, instance.volume);
    given.medium = pick(outer.medium, instance.medium);
    given.alpha = outer.alpha != scene::Input<float>{1} ? outer.alpha : instance.alpha;
    given.priority = outer.priority != 0 ? outer.priority : instance.priority;
    given.visibility = all_of(outer.visibility, instance.visibility);
    given.holdout = outer.holdout || instance.holdout;
    given.shadow_catcher = outer.shadow_catcher || instance.shadow_catcher;
    given.sets = outer.sets |
                 world_.sets_.declare(instance.sets, location_of(scene_, scene::InstanceId{index}));
    given.trace_distance =
        outer.trace_distance > 0 ? outer.trace_distance : instance.trace_distance;
    given.root_instance = outer.root_instance >= 0 ? outer.root_instance : index;
    given.group_instance = outer.group_instance;
    if (given.group_instance < 0 && !instance.group.empty()) given.group_instance = index;
    if (auto const* group = std::get_if<scene::Group>(&shape)) {
        for (scene::InstanceId member : group->instances) add_instance(member.index, given);
    } else {
        add_object(shape, index, given);
    }
}

void WorldBuilder::add_object(scene::Shape const& shape, int32_t instance, Inherited const& given) {
    Object object;
    object.material = given.material;
    if (given.emission) {
        auto const& emission = scene_.emissions[size_t(given.emission.index)];
        object.emission.color = emission.emission;
        object.emission.tint = scene::scale_of(emission.color, emission.unit);
    }
    object.normal_map = given.normal_map;
    object.opacity.instance = given.alpha;
    object.priority = given.priority;
    object.source_instance = instance;
    object.root_instance = given.root_instance;
    object.group_instance = given.group_instance;
    object.medium = medium_of(given);
    object.visibility = given.visibility;
    object.sets = given.sets;
    object.trace_distance = given.trace_distance;
    object.holdout = given.holdout;
    object.shadow_catcher = given.shadow_catcher;
    if (given.material) {
        auto const& material = scene_.materials[size_t(given.material.index)];
        object.is_null = scene::is_null_boundary(material);
        object.has_interior = scene::is_transmissive(scene_, given.material);
        object.is_see_through =
            !object.has_interior && scene::passes_straight(scene_, given.material);
        object.opacity.material = scene::opacity_of(material);
        if (auto const own = scene::emission_of(material); own && !given.emission)
            object.emission = {own->color, own->strength};
    }
    object.has_alpha = object.opacity != shading::Opacity{};
    // A medium without a surface material is bounded by nothing, and nothing does not shine.
    if (!given.material && !given.emission && object.medium >= 0)
        object.is_null = object.has_interior = true;
    if (object.is_null) object.emission = {};
    world_.has_alpha_ |= object.has_alpha;
    world_.has_media_ |= object.is_null || object.medium >= 0;

    object.to_world = Affine(given.transform);
    object.to_object = Affine(given.transform.inverse());
    if (std::holds_alternative<scene::Sphere>(shape)) {
        object.kind = ObjectKind::Sphere;
        object.instanced = !keeps_round(given.transform);
    } else if (std::holds_alternative<scene::Disk>(shape)) {
        object.kind = ObjectKind::Disk;
        object.instanced = !keeps_circles(given.transform);
    } else if (auto const* mesh = std::get_if<scene::MeshShape>(&shape)) {
        int32_t const file = mesh->filename.resource;
        auto const& data = scene_.meshes[size_t(file)];
        object.instanced = mesh_uses_[file] > 1 && data->triangles.size() > kInstancingThreshold;
        object.triangles = object.instanced ? shared_triangles(file, mesh->smooth)
                                            : baked_triangles(data, mesh->smooth, given.transform);
    } else {
        object.triangles = baked_triangles(rectangle_, false, given.transform);
        object.is_rectangle = true;
    }
    world_.objects_.push_back(std::move(object));
}

/// Programs for all that objects show: what nothing uses is not compiled.
void WorldBuilder::compile_networks() {
    world_.textures_ = shading::Textures(scene_.textures.size());
    world_.materials_ = shading::Materials(scene_);
    for (Object& o : world_.objects_) {
        SourceLocation const where = location_of(scene_, scene::InstanceId{o.source_instance});
        o.has_tangents = bool(o.normal_map);
        auto look = [&](shading::Needs needs) {
            o.has_tangents |= !within(needs, shading::Needs::uv | shading::Needs::view);
        };
        auto prepare = [&](scene::TextureId id) {
            world_.textures_.prepare(compiler_, id, where);
            look(world_.textures_.needs(id));
        };
        prepare(o.opacity.instance.texture);
        prepare(o.opacity.material.texture);
        prepare(o.normal_map);
        prepare(o.emission.color.texture);
        prepare(o.emission.strength.texture);
        if (!o.material) continue;
        o.ior = scene::inner_ior(scene_, o.material).value_or(scene::Input<float>{1});
        prepare(o.ior.texture);
        world_.materials_.compile(scene_, o.material, compiler_);
        look(world_.materials_.needs(o.material));
        o.has_tangents |= world_.materials_.uses_tangents(o.material);
    }
}

/// The meshes' properties that programs read. One that no mesh has is a mistake.
void WorldBuilder::attach_attributes() {
    for (auto const& [name, node] : compiler_.attributes()) {
        bool found = false;
        std::vector<std::string> known;
        for (TriangleData& data : world_.triangles_) {
            scene::Mesh const& mesh = *data.source;
            shading::VertexAttributes::Column column;
            if (!mesh.colors.empty()) {
                known.emplace_back("color");
                if (name == "color") column = {&mesh.colors[0].r, 3};
            }
            for (scene::VertexAttribute const& a : mesh.attributes) {
                known.push_back(a.name);
                if (a.name == name) column = {a.values.data(), a.components};
            }
            found |= column.values != nullptr;
            data.attributes.mesh = &mesh;
            data.attributes.columns.push_back(column);
        }
        if (found) continue;
        std::sort(known.begin(), known.end());
        known.erase(std::unique(known.begin(), known.end()), known.end());
        throw InputError(location_of(scene_, node),
                         "expected a vertex property of some mesh, found '" + name + "'" +
                             (known.empty() ? ": no mesh has any" : suggestion(name, known)));
    }
}

int32_t WorldBuilder::add_medium(media::Medium const& medium) {
    world_.media_.push_back(medium);
    world_.has_media_ = true;
    return int32_t(world_.media_.size()) - 1;
}

int32_t WorldBuilder::medium_of(Inherited const& given) {
    if (given.medium) {
        auto const& m = scene_.media[size_t(given.medium.index)];
        return add_medium({m.absorption, m.scatter, m.phase});
    }
    if (!given.material) return -1;
    auto const* v =
        std::get_if<scene::VolumeBoundary>(&scene_.materials[size_t(given.material.index)]);
    if (!v) return -1;
    float const density = given.volume ? scene_.volumes[size_t(given.volume.index)].value : 1;
    // What a scattering event takes away by its colour is absorbed.
    Color const scattering = density * v->scatter * v->base_color;
    return add_medium({density * (v->absorption + v->scatter) - scattering, scattering, v->phase});
}

int32_t WorldBuilder::shared_triangles(int32_t mesh, bool smooth) {
    auto const [it, fresh] = shared_.emplace(std::pair(mesh, smooth), -1);
    if (fresh) it->second = baked_triangles(scene_.meshes[size_t(mesh)], smooth, Affined());
    return it->second;
}

int32_t WorldBuilder::baked_triangles(std::shared_ptr<scene::Mesh const> mesh, bool smooth,
                                      Affined const& transform) {
    TriangleData data;
    data.mirrored = transform.determinant() < 0;
    data.smooth = smooth && !mesh->normals.empty();
    data.has_uvs = !mesh->uvs.empty();
    data.vertices.resize(mesh->positions.size());
    for (size_t i = 0; i < data.vertices.size(); ++i) {
        data.vertices[i].p = Vec3(transform.point(Vec3d(mesh->positions[i])));
        if (!data.has_uvs) continue;
        data.vertices[i].u = mesh->uvs[i].x;
        data.vertices[i].v = mesh->uvs[i].y;
    }
    if (data.smooth) {
        Affined const inverse = transform.inverse();
        // Not to length 1: an instance's normals are interpolated before they are transformed, and
        // both ways are to give the same. The factor keeps them near it.
        double const scale = std::cbrt(std::abs(transform.determinant()));
        for (size_t i = 0; i < data.vertices.size(); ++i)
            data.vertices[i].n = Vec3(inverse.transposed(Vec3d(mesh->normals[i])) * scale);
    }
    data.source = std::move(mesh);
    world_.triangles_.push_back(std::move(data));
    return int32_t(world_.triangles_.size()) - 1;
}

void WorldBuilder::count() {
    WorldStatistics& s = world_.statistics_;
    s.objects = world_.objects_.size();
    std::set<image::Texture const*> images;
    for (auto const& image : scene_.images) images.insert(image.get());
    for (auto const* image : images) s.memory_bytes += image->memory_bytes();
    for (TriangleData const& t : world_.triangles_) {
        s.unique_triangles += t.source->triangles.size();
        s.memory_bytes += t.vertices.size() * sizeof(Vertex) + t.source->triangles.size() * 12;
    }
    for (Object const& o : world_.objects_)
        if (o.triangles >= 0)
            s.triangles += world_.triangles_[size_t(o.triangles)].source->triangles.size();
}

} // namespace weft::world
