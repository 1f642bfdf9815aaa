// The hierarchy of nodes of a glTF file, flattened: every primitive of every node's mesh becomes an
// instance with its transform to the world; meshes are shared.
#pragma once

#include "io/gltf.h"
#include "io/gltf_material.h"

namespace weft::io::gltf {

class NodeReader {
  public:
    NodeReader(File& file, scene::Scene& scene, image::TextureCache& images)
        : file_(file), scene_(scene), materials_(file, scene, images) {}

    /// Reads the file's default scene.
    GltfContents read();

  private:
    struct Visit {
        size_t node;
        Affined parent;
        std::string from; ///< the path that names the node
    };
    /// One primitive, as instances need it.
    struct Part {
        scene::ShapeId shape;
        Surface surface;
    };

    std::vector<Visit> roots();
    void visit(Visit const& visit);
    Affined local_transform(Object& node);
    std::vector<Part> const& mesh(size_t index);
    void add_instances(Object& node, size_t mesh, Affined const& to_world);
    std::vector<Affined> gpu_instances(Object& node);
    /// Returns false, and adds nothing, where the transform leaves no volume or no numbers.
    bool add_instance(Part const& part, Affined const& to_world, SourceLocation const& where,
                      SharedText const& name);
    void add_camera(Object& camera, Affined const& to_world);
    void add_light(Object& light, Affined const& to_world, Object const& node);

    File& file_;
    scene::Scene& scene_;
    MaterialReader materials_;
    GltfContents contents_;
    std::vector<Object> lights_; ///< of KHR_lights_punctual
    std::vector<Visit> open_;
    std::vector<bool> visited_;
    std::map<size_t, std::vector<Part>> meshes_;
    uint64_t vertices_ = 0; ///< of all meshes so far
};

} // namespace weft::io::gltf
