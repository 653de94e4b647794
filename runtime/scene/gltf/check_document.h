#pragma once

#include "runtime/scene/gltf/document.h"

namespace gazeloop::scene::gltf {

/// Ranges, strides and alignments of views and accessors, types of what primitives use, and that
/// nodes form trees. Precondition: every index has been checked. Throws Refusal.
void check_document(const Document& document, Notes& notes);

}  // namespace gazeloop::scene::gltf
