#include "runtime/scene/gltf/scene_walk.h"

#include <fmt/format.h>

#include <cmath>

namespace gazeloop::scene::gltf {
namespace {

struct OpenNode {
    std::uint32_t node;
    glm::dmat4 world_from_parent;
};

/// The single precision that is rendered in.
glm::mat4x3 placement_of(const glm::dmat4& world_from_node, std::uint32_t node) {
    const glm::mat4x3 placement(world_from_node);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (!std::isfinite(placement[column][row])) {
                refuse(fmt::format("/nodes/{}", node),
                       "lies or is scaled beyond what single precision holds");
            }
        }
    }
    return placement;
}

/// A unit vector along an axis of a frame; none where it is scaled to nothing.
std::optional<glm::vec3> direction_of(const glm::dvec3& axis) {
    const double length = glm::length(axis);
    return length > 0.0 && std::isfinite(length) ? std::optional(glm::vec3(axis / length))
                                                 : std::nullopt;
}

class Walk {
  public:
    Walk(const Document& document, Notes& notes) : document_(document), notes_(notes) {}

    ShownNodes walk() {
        for (auto root = document_.roots.rbegin(); root != document_.roots.rend(); ++root) {
            open_.push_back({*root, glm::dmat4(1.0)});
        }
        // With a list of its own, since a file may nest nodes deeper than the stack is.
        while (!open_.empty()) {
            const OpenNode at = open_.back();
            open_.pop_back();
            visit(at);
        }
        return std::move(shown_);
    }

  private:
    void visit(const OpenNode& at) {
        const Node& node = document_.nodes.at(at.node);
        const glm::dmat4 world_from_node = at.world_from_parent * node.parent_from_node;
        const glm::mat4x3 placement = placement_of(world_from_node, at.node);
        if (node.mesh) {
            place_mesh(*node.mesh, placement, at.node);
        }
        if (node.light) {
            place_light(*node.light, world_from_node, at.node);
        }
        if (node.is_camera) {
            shown_.viewpoints.push_back({.name = node.name, .world_from_camera = placement});
        }
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
            open_.push_back({*child, world_from_node});
        }
    }

    void place_mesh(std::uint32_t mesh, const glm::mat4x3& placement, std::uint32_t node) {
        if (glm::determinant(glm::dmat3(placement)) == 0.0) {
            notes_.add("flat node", fmt::format("/nodes/{}", node),
                       "is scaled to nothing: not shown");
            return;
        }
        shown_.meshes.push_back({mesh, placement});
    }

    void place_light(std::uint32_t index, const glm::dmat4& world_from_node, std::uint32_t node) {
        mesh::Light light = document_.lights.at(index);
        light.position_m = glm::vec3(world_from_node[3]);
        const auto direction = direction_of(-glm::dvec3(world_from_node[2]));
        if (!direction) {
            notes_.add("light without direction", fmt::format("/nodes/{}", node),
                       "holds a light and is scaled to nothing: it is left out");
            return;
        }
        light.direction = *direction;
        shown_.lights.push_back(light);
    }

    const Document& document_;
    Notes& notes_;
    std::vector<OpenNode> open_;
    ShownNodes shown_;
};

}  // namespace

ShownNodes walk_scene(const Document& document, Notes& notes) {
    return Walk(document, notes).walk();
}

}  // namespace gazeloop::scene::gltf
