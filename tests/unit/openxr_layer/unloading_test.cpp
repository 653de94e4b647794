// The layer's library, loaded and unloaded as a loader may do it while its application runs on.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>

#include "tests/unit/openxr_layer/gaze_reader.h"
#include "tests/unit/openxr_layer/mock_application.h"
#include "tests/unit/openxr_layer/mock_home.h"

namespace gazeloop::openxr_layer {
namespace {

const std::string kLibrary = GAZELOOP_BINARY_DIR "/openxr_layer/libXrApiLayer_gazeloop.so";

/// While it lives, instances go through the library.
class LoadedLayer {
  public:
    LoadedLayer() : library_(dlopen(kLibrary.c_str(), RTLD_NOW | RTLD_LOCAL)) {
        using Negotiate = XrResult(XRAPI_PTR*)(const XrNegotiateLoaderInfo*, const char*,
                                               XrNegotiateApiLayerRequest*);
        const auto negotiate =
            library_ != nullptr
                ? reinterpret_cast<Negotiate>(dlsym(library_, "xrNegotiateLoaderApiLayerInterface"))
                : nullptr;
        XrNegotiateLoaderInfo loader{XrLoaderStruct::LoaderInfo,
                                     1,
                                     sizeof loader,
                                     kLoaderInterfaceVersion,
                                     kLoaderInterfaceVersion,
                                     XR_MAKE_VERSION(1, 0, 0),
                                     XR_MAKE_VERSION(1, 0x3FF, 0xFFF)};
        XrNegotiateApiLayerRequest request{};
        request.structType = XrLoaderStruct::ApiLayerRequest;
        request.structSize = sizeof request;
        if (negotiate == nullptr || XR_FAILED(negotiate(&loader, kLayerName, &request))) {
            throw std::runtime_error(kLibrary + " is not the layer's library");
        }
        MockRuntime::the().set_layer({request.createApiLayerInstance, request.getInstanceProcAddr});
    }
    LoadedLayer(const LoadedLayer&) = delete;
    LoadedLayer& operator=(const LoadedLayer&) = delete;
    ~LoadedLayer() {
        MockRuntime::the().set_layer({});
        dlclose(library_);
    }

  private:
    void* library_;
};

bool is_loaded() {
    void* const library = dlopen(kLibrary.c_str(), RTLD_NOW | RTLD_NOLOAD);
    if (library != nullptr) {
        dlclose(library);
    }
    return library != nullptr;
}

/// With sources that have a thread of their own, and a recording that is written by others.
TEST(LayerLibrary, IsUnloadedAndComesBack) {
    const Home home;
    for (int round = 0; round < 4; ++round) {
        set_settings(
            "layer.gaze=" +
            (round % 2 == 0 ? "steam-frame:" + (home.folder.path() / "none").string() : "sim") +
            "\nlayer.record=" + home.folder.path().string());
        ASSERT_FALSE(is_loaded()) << round;
        const LoadedLayer loaded;
        ASSERT_TRUE(is_loaded());
        MockApplication application;
        make_gaze_reader(application);
        for (int frame = 0; frame < 5; ++frame) {
            EXPECT_EQ(application.sync(), XR_SUCCESS);
            application.frame(application.spaces[2]);
        }
        EXPECT_FALSE(MockRuntime::the().saw_eyes());
        // Whatever its session and instance hold goes with them.
        application.call<PFN_xrDestroySession>("xrDestroySession")(application.session);
    }
    EXPECT_FALSE(is_loaded());
}

}  // namespace
}  // namespace gazeloop::openxr_layer
