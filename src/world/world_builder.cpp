#include "world/world_builder.h"

#include <algorithm>
#include <set>

#include "base/hash.h"
#include "base/match.h"
#include "scene/camera_relative.h"
#include "scene/check.h"

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

} // namespace

std::unique_ptr<World> World::commit(std::shared_ptr<scene::Scene const> scene,
                                     CommitOptions const& options) {
    scene::check(*scene);
    auto [placed, origin] = scene::camera_relative(std::move(scene));
    std::unique_ptr<World> world(new World);
    world->scene_ = placed;
    world->origin_ = origin;
    world->recorder_ = options.recorder;
    WorldBuilder(*world, *placed, options).build();
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
    mask_models();
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
    world_.meshes_.assign(meshes_.begin(), meshes_.end());
}

void WorldBuilder::collect_instances() {
    std::map<int32_t, scene::LightId> area_lights; // by instance
    for (scene::LightId id : scene_.contents.lights)
        if (auto const* area = std::get_if<scene::AreaLight>(&scene_.lights[size_t(id.index)]))
            area_lights[area->instance.index] = id;
    std::vector<int32_t> roots;
    std::set<int32_t> listed; // of the instances that are lights
    for (scene::InstanceId id : scene_.contents.instances) {
        roots.push_back(id.index);
        if (area_lights.contains(id.index)) listed.insert(id.index);
    }
    // An instance that the scene lists as well is not there twice.
    for (scene::LightId id : scene_.contents.lights)
        if (auto const* area = std::get_if<scene::AreaLight>(&scene_.lights[size_t(id.index)]))
            if (listed.insert(area->instance.index).second) roots.push_back(area->instance.index);
    count_uses(roots);
    world_.objects_.reserve(object_count_);
    for (int32_t root : roots) {
        size_t const first = world_.objects_.size();
        add_instance(root, {});
        if (auto const it = area_lights.find(root); it != area_lights.end())
            for (size_t i = first; i < world_.objects_.size(); ++i)
                if (world_.model(uint32_t(i)).emission) add_area_object(uint32_t(i), it->second);
    }
}

/// Counts objects, in all and by mesh. A group counts its members for every instance of the group.
void WorldBuilder::count_uses(std::vector<int32_t> const& roots) {
    std::vector<int32_t> open = roots;
    while (!open.empty()) {
        scene::Instance const& instance = scene_.instances[size_t(open.back())];
        open.pop_back();
        scene::Shape const& shape = scene_.shapes[size_t(instance.shape.index)];
        if (auto const* group = std::get_if<scene::Group>(&shape)) {
            for (scene::InstanceId id : group->instances) open.push_back(id.index);
            continue;
        }
        ++object_count_;
        if (auto const* mesh = std::get_if<scene::MeshShape>(&shape))
            ++mesh_uses_[mesh->filename.resource];
    }
}

void WorldBuilder::add_area_object(uint32_t object, scene::LightId light) {
    auto const& area = std::get<scene::AreaLight>(scene_.lights[size_t(light.index)]);
    world_.models_[world_.object(object).model].spread = shading::Spread(area.spread);
    world_.area_objects_.push_back({object, light});
}

void WorldBuilder::add_instance(int32_t index, Inherited const& outer) {
    scene::Instance const& instance = scene_.instances[size_t(index)];
    scene::Shape const& shape = scene_.shapes[size_t(instance.shape.index)];
    if (!instance.traits.sets.empty())
        world_.sets_.declare(instance.traits.sets, location_of(scene_, scene::InstanceId{index}));
    if (outer.root_instance < 0 && !std::holds_alternative<scene::Group>(shape))
        return add_object(shape, index, {instance.transform, instance.traits});
    Inherited const given{outer.transform * instance.transform,
                          inherit(outer.traits, instance.traits),
                          outer.root_instance >= 0 ? outer.root_instance : index};
    if (auto const* group = std::get_if<scene::Group>(&shape)) {
        for (scene::InstanceId member : group->instances) add_instance(member.index, given);
    } else {
        add_object(shape, index, given);
    }
}

void WorldBuilder::add_object(scene::Shape const& shape, int32_t instance, Inherited const& given) {
    Placed const placed = match(shape, [&](auto const& s) { return place(s, given.transform); });
    Object object{model_of(placed, given.traits, instance), instance};
    if (given.root_instance >= 0) {
        object.member = uint32_t(world_.members_.size());
        world_.members_.push_back({given.transform, given.root_instance});
    }
    world_.objects_.push_back(object);
    Model const& model = world_.models_[object.model];
    world_.has_alpha_ |= model.has_alpha;
    world_.has_media_ |= model.is_null || model.medium >= 0;
}

WorldBuilder::Placed WorldBuilder::place(scene::Rectangle const&, Affined const& to_world) {
    return {TriangleMesh(add_mesh(rectangle_, false, to_world)), false, true};
}

WorldBuilder::Placed WorldBuilder::place(scene::MeshShape const& shape, Affined const& to_world) {
    int32_t const file = shape.filename.resource;
    auto const& mesh = scene_.meshes[size_t(file)];
    if (mesh_uses_[file] > 1 && mesh->triangles.size() > kInstancingThreshold)
        return {TriangleMesh(shared_mesh(file, shape.smooth)), true, false};
    return {TriangleMesh(add_mesh(mesh, shape.smooth, to_world)), false, true};
}

WorldBuilder::Placed WorldBuilder::place(scene::Group const&, Affined const&) {
    throw std::logic_error("a group is no object");
}

MeshData const& WorldBuilder::shared_mesh(int32_t mesh, bool smooth) {
    auto const [it, fresh] = shared_meshes_.emplace(std::pair(mesh, smooth), nullptr);
    if (fresh) it->second = &add_mesh(scene_.meshes[size_t(mesh)], smooth, Affined());
    return *it->second;
}

MeshData const& WorldBuilder::add_mesh(std::shared_ptr<scene::Mesh const> mesh, bool smooth,
                                       Affined const& transform) {
    MeshData& data = *meshes_.emplace_back(std::make_shared<MeshData>());
    data.mirrored = transform.determinant() < 0;
    data.smooth = smooth && !mesh->normals.empty();
    data.has_uvs = !mesh->uvs.empty();
    data.is_rectangle = mesh == rectangle_;
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
    return data;
}

WorldBuilder::GeometryKey WorldBuilder::key_of(Geometry const& geometry) {
    return {geometry.index(), match(geometry, [](auto const& g) { return g.made_of(); })};
}

/// Objects that emit have a model each, since a light may change what they emit.
uint32_t WorldBuilder::model_of(Placed const& placed, scene::InstanceTraits const& traits,
                                int32_t instance) {
    auto const [kind, made_of] = key_of(placed.geometry);
    size_t const hash =
        hash_combine(hash_combine(hash_of(traits), std::hash<void const*>()(made_of)),
                     2 * kind + placed.instanced);
    auto const [first, last] = shared_models_.equal_range(hash);
    for (auto it = first; it != last; ++it) {
        Model const& m = world_.models_[it->second];
        if (m.geometry == placed.geometry && m.instanced == placed.instanced && m.traits == traits)
            return it->second;
    }
    uint32_t const index = uint32_t(world_.models_.size());
    world_.models_.push_back(make_model(placed, traits, instance));
    first_instance_.push_back(instance);
    if (!world_.models_.back().emission && !placed.in_world_space)
        shared_models_.emplace(hash, index);
    return index;
}

void WorldBuilder::count() {
    WorldStatistics& s = world_.statistics_;
    s.objects = world_.objects_.size();
    std::set<image::Texture const*> images;
    for (auto const& image : scene_.images) images.insert(image.get());
    for (auto const* image : images) s.memory_bytes += image->memory_bytes();
    for (auto const& mesh : meshes_) {
        s.unique_triangles += mesh->source->triangles.size();
        s.memory_bytes +=
            mesh->vertices.size() * sizeof(Vertex) + mesh->source->triangles.size() * 12;
    }
    s.memory_bytes += s.objects * (sizeof(Object) + sizeof(scene::Instance)) +
                      world_.models_.size() * sizeof(Model);
    for (Object const& o : world_.objects_)
        if (auto const* mesh = std::get_if<TriangleMesh>(&world_.models_[o.model].geometry))
            s.triangles += mesh->data->source->triangles.size();
}

} // namespace weft::world
