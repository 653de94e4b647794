#pragma once

#include "runtime/methods/acuity_settings.h"
#include "runtime/methods/fixed_settings.h"
#include "runtime/methods/interleaved_settings.h"
#include "runtime/methods/kfr3d_settings.h"
#include "runtime/methods/kfr_settings.h"
#include "runtime/methods/layers_settings.h"
#include "runtime/methods/quad_settings.h"
#include "runtime/methods/rings_settings.h"
#include "runtime/methods/sparse_settings.h"

namespace gazeloop::methods {

/// The settings of all methods. registry.h has their rows.
struct MethodSettings {
    AcuitySettings acuity;
    FixedSettings fixed;
    InterleavedSettings interleaved;
    KfrSettings kfr;
    Kfr3dSettings kfr3d;
    LayersSettings layers;
    QuadSettings quad;
    RingsSettings rings;
    SparseSettings sparse;
};

}  // namespace gazeloop::methods
