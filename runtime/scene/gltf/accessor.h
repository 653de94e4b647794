#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "runtime/scene/gltf/document.h"
#include "runtime/scene/gltf/resource.h"

namespace gazeloop::scene::gltf {

/// A document with its buffers. Precondition of all below: check_document() has passed, and the
/// buffers have the bytes that it says.
struct Source {
    const Document& document;
    const std::vector<Buffer>& buffers;
};

/// The unsigned integers of an accessor of scalars, sparse ones applied. Throws Refusal where
/// sparse indices are not as they must be.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const Source& source, std::uint32_t accessor);

/// Where element `index` of a sparse accessor's replacements goes; they must increase.
[[nodiscard]] std::vector<std::uint32_t> read_sparse_indices(const Source& source,
                                                             std::uint32_t accessor);

namespace detail {

/// A component as the standard's float (section 3.6.2.2 of glTF 2.0, equations of normalised ones).
template <typename Stored>
float component_at(const std::byte* bytes, bool normalized) {
    Stored stored{};
    std::memcpy(&stored, bytes, sizeof stored);
    const auto number = static_cast<float>(stored);
    if constexpr (std::is_integral_v<Stored> && sizeof(Stored) <= 2) {
        if (normalized) {
            return std::max(number / static_cast<float>(std::numeric_limits<Stored>::max()), -1.0F);
        }
    }
    return number;
}

[[noreturn]] inline void refuse_not_finite(std::uint32_t accessor, std::uint64_t element) {
    refuse(fmt::format("/accessors/{}", accessor),
           fmt::format("element {} is not a finite number; export the scene without it", element));
}

template <typename Stored, typename Put>
void put_elements(const std::byte* from, std::size_t stride, const Accessor& accessor,
                  std::uint32_t index, std::uint64_t first, std::uint64_t count, Put& put) {
    const std::uint32_t components = component_count(accessor.type);
    std::array<float, 4> element{};
    for (std::uint64_t i = 0; i < count; ++i, from += stride) {
        for (std::uint32_t c = 0; c < components; ++c) {
            element[c] = component_at<Stored>(from + c * sizeof(Stored), accessor.normalized);
            if constexpr (std::is_floating_point_v<Stored>) {
                if (!std::isfinite(element[c])) {
                    refuse_not_finite(index, first + i);
                }
            }
        }
        put(first + i, element);
    }
}

template <typename Put>
void put_any(const std::byte* from, std::size_t stride, const Accessor& accessor,
             std::uint32_t index, std::uint64_t first, std::uint64_t count, Put& put) {
    const auto with = [&]<typename Stored>(Stored /*type*/) {
        put_elements<Stored>(from, stride, accessor, index, first, count, put);
    };
    switch (accessor.component) {
        case Component::Int8:
            return with(std::int8_t{});
        case Component::Uint8:
            return with(std::uint8_t{});
        case Component::Int16:
            return with(std::int16_t{});
        case Component::Uint16:
            return with(std::uint16_t{});
        case Component::Uint32:
            return with(std::uint32_t{});
        case Component::Float:
            return with(float{});
    }
}

}  // namespace detail

/// Calls put(i, element) for elements [first, first + count), as floats: integers that are
/// normalised become [0, 1] or [-1, 1], components that there are not are 0. Those that sparse ones
/// replace are told twice, the second time as they are. Scalars and vectors alone. Throws Refusal
/// for what is not finite.
template <typename Put>
void read_elements(const Source& source, std::uint32_t index, std::uint64_t first,
                   std::uint64_t count, Put put) {
    const Accessor& accessor = source.document.accessors.at(index);
    const std::size_t bytes_each = element_bytes(accessor.type, accessor.component);
    if (accessor.view) {
        const std::size_t stride = source.document.views.at(*accessor.view).stride;
        const std::size_t step = stride == 0 ? bytes_each : stride;
        const auto bytes = bytes_of(source.document, source.buffers, *accessor.view);
        detail::put_any(bytes.data() + accessor.offset + first * step, step, accessor, index, first,
                        count, put);
    } else {
        for (std::uint64_t i = first; i < first + count; ++i) {
            put(i, std::array<float, 4>{});
        }
    }
    if (accessor.sparse) {
        const auto where = read_sparse_indices(source, index);
        const auto values = bytes_of(source.document, source.buffers, accessor.sparse->value_view);
        for (std::size_t i = 0; i < where.size(); ++i) {
            if (where[i] >= first && where[i] < first + count) {
                detail::put_any(values.data() + accessor.sparse->value_offset + i * bytes_each,
                                bytes_each, accessor, index, where[i], 1, put);
            }
        }
    }
}

}  // namespace gazeloop::scene::gltf
