#pragma once

#include <array>
#include <map>
#include <vector>

#include "runtime/scene/gltf/document.h"

namespace gazeloop::scene::gltf {

/// A picture of the file in one colour space: what becomes one mesh::Image.
struct UsedImage {
    std::uint32_t image = 0;  ///< of the document
    mesh::ColorSpace color_space = mesh::ColorSpace::Linear;
    std::string place;  ///< of the first use, a JSON pointer
};

/// A material as the renderer gets it, and what the shapes that bear it need.
struct ShownMaterial {
    mesh::Material material;
    std::array<std::uint32_t, 2> uv_sets{mesh::kNone, mesh::kNone};  ///< as GeometryKey
    std::uint32_t tangent_slot = mesh::kNone;
};

/// Gives materials of the document their images and texture coordinates. The same picture in the
/// same colour space is one image, whoever uses it.
class MaterialImages {
  public:
    MaterialImages(const Document& document, Notes& notes) : document_(document), notes_(notes) {}

    /// `material` of the document; none: the standard's default.
    [[nodiscard]] ShownMaterial show(std::optional<std::uint32_t> material);

    /// What the materials shown so far refer to, by mesh::TextureUse::image.
    [[nodiscard]] const std::vector<UsedImage>& images() const { return images_; }

  private:
    mesh::TextureUse use_of(const std::optional<TextureReference>& reference,
                            mesh::ColorSpace color_space, ShownMaterial& shown);
    std::uint32_t image_of(std::uint32_t image, mesh::ColorSpace color_space,
                           const std::string& place);

    const Document& document_;
    Notes& notes_;
    std::vector<UsedImage> images_;
    std::map<std::pair<std::uint32_t, mesh::ColorSpace>, std::uint32_t> index_;
};

}  // namespace gazeloop::scene::gltf
