#include "runtime/scene/gallery/gallery_materials.h"

#include <array>
#include <optional>
#include <string_view>

#include "runtime/scene/gallery/gallery_textures.h"

namespace gazeloop::scene::gallery {
namespace {

constexpr std::uint32_t kTexels = 256;

/// One line of the palette.
struct Paint {
    std::string_view name;
    std::optional<Pattern> pattern;
    glm::vec3 color;
    float metallic = 0.0F;
    float roughness = 1.0F;
    float transmission = 0.0F;
    glm::vec3 emissive{0.0F};
};

constexpr std::array kObjects{
    Paint{"plaster", Pattern::Plaster, {1.0F, 1.0F, 1.0F}},
    Paint{"stone", Pattern::Stone, {1.0F, 1.0F, 1.0F}, 0.0F, 0.75F},
    Paint{"brick", Pattern::Brick, {1.0F, 1.0F, 1.0F}},
    Paint{"polished marble", Pattern::Stone, {0.95F, 1.0F, 0.97F}, 0.0F, 0.16F},
    Paint{"varnished wood", Pattern::Wood, {1.0F, 1.0F, 1.0F}, 0.0F, 0.3F},
    Paint{"glazed tile", Pattern::Tile, {1.0F, 1.0F, 1.0F}, 0.0F, 0.6F},
    Paint{"red plastic", std::nullopt, {0.62F, 0.04F, 0.03F}, 0.0F, 0.32F},
    Paint{"blue lacquer", std::nullopt, {0.02F, 0.08F, 0.42F}, 0.0F, 0.1F},
    Paint{"brushed steel", Pattern::Brushed, {0.62F, 0.61F, 0.60F}, 1.0F, 0.36F},
    Paint{"gold", std::nullopt, {1.0F, 0.71F, 0.29F}, 1.0F, 0.2F},
    Paint{"hammered copper", Pattern::Hammered, {0.95F, 0.60F, 0.45F}, 1.0F, 0.22F},
    Paint{"mirror", std::nullopt, {0.92F, 0.93F, 0.94F}, 1.0F, 0.03F},
    Paint{"glass", std::nullopt, {0.97F, 0.99F, 0.98F}, 0.0F, 0.02F, 1.0F},
    Paint{"amber glass", std::nullopt, {0.95F, 0.62F, 0.22F}, 0.0F, 0.04F, 1.0F},
    Paint{"lamp", std::nullopt, {0.8F, 0.75F, 0.7F}, 0.0F, 0.5F, 0.0F, {1.6F, 1.1F, 0.6F}}};

constexpr Paint kGround{"ground", Pattern::Ground, {1.0F, 1.0F, 1.0F}};

/// Images of a pattern, painted when they are first used.
class Patterns {
  public:
    explicit Patterns(mesh::MeshData& data) : data_(&data) {}

    /// The first of the three images of PatternImages, in its order.
    std::uint32_t first_image(Pattern pattern) {
        std::optional<std::uint32_t>& first = first_.at(static_cast<std::size_t>(pattern));
        if (!first) {
            first = static_cast<std::uint32_t>(data_->images.size());
            PatternImages made = paint(pattern, kTexels);
            data_->images.push_back(std::move(made.color));
            data_->images.push_back(std::move(made.normal));
            data_->images.push_back(std::move(made.surface));
        }
        return *first;
    }

  private:
    mesh::MeshData* data_;
    std::array<std::optional<std::uint32_t>, 8> first_{};
};

mesh::Material material_of(const Paint& paint, Patterns& patterns) {
    mesh::Material material;
    material.name = paint.name;
    material.base_color = glm::vec4(paint.color, 1.0F);
    material.metallic = paint.metallic;
    material.roughness = paint.roughness;
    material.transmission = paint.transmission;
    material.emissive = paint.emissive;
    if (paint.pattern) {
        const std::uint32_t first = patterns.first_image(*paint.pattern);
        material.base_color_texture.image = first;
        material.normal_texture.image = first + 1;
        material.occlusion_texture.image = first + 2;
        material.metallic_roughness_texture.image = first + 2;
    }
    return material;
}

}  // namespace

std::size_t object_materials() { return kObjects.size(); }

std::uint32_t ground_material() { return static_cast<std::uint32_t>(kObjects.size()); }

void add_materials(mesh::MeshData& data) {
    Patterns patterns(data);
    for (const Paint& paint : kObjects) {
        data.materials.push_back(material_of(paint, patterns));
    }
    data.materials.push_back(material_of(kGround, patterns));
}

}  // namespace gazeloop::scene::gallery
