#include "runtime/preview/preview_window.h"

#include <GLFW/glfw3.h>
#include <fmt/core.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "runtime/preview/gamepads.h"
#include "runtime/preview/preview_memory.h"

namespace gazeloop::preview {
namespace {

constexpr double kPollS = 0.004;  ///< how late a picture may be noticed
constexpr int kLargestStartPx = 1600;
constexpr int kSmallestStartPx = 320;
constexpr float kRowPx = 18.0F;
constexpr float kMarginPx = 8.0F;
constexpr ImU32 kInk = IM_COL32(235, 235, 235, 255);
constexpr ImU32 kShade = IM_COL32(0, 0, 0, 190);
constexpr ImU32 kRing = IM_COL32(255, 32, 32, 255);
constexpr ImU32 kBudget = IM_COL32(255, 255, 255, 255);
/// Okabe and Ito's colours, which colour-blind people tell apart, but for the one too dark to read.
// One for each segment of a bar; after those eight, lighter ones of the first four.
constexpr std::array<ImU32, 12> kColours{
    IM_COL32(86, 180, 233, 255),  IM_COL32(230, 159, 0, 255),   IM_COL32(0, 158, 115, 255),
    IM_COL32(204, 121, 167, 255), IM_COL32(213, 94, 0, 255),    IM_COL32(240, 228, 66, 255),
    IM_COL32(150, 150, 255, 255), IM_COL32(190, 190, 190, 255), IM_COL32(170, 218, 244, 255),
    IM_COL32(247, 210, 130, 255), IM_COL32(120, 210, 185, 255), IM_COL32(232, 190, 214, 255)};
static_assert(kColours.size() >= kBarSegments);

std::string last_error;

void on_error(int /*code*/, const char* text) { last_error = text; }

void say(const std::string& text) {
    // The loop may be gone; then there is no one to tell.
    static_cast<void>(send(kWindowSocketFd, text.data(), text.size(), MSG_NOSIGNAL));
}

bool loop_is_gone() {
    pollfd socket{kWindowSocketFd, POLLIN, 0};
    return poll(&socket, 1, 0) != 0;  // it never says anything: readable means closed
}

class Window {
  public:
    Window(GLFWwindow* window, PreviewMemory& memory) : window_(window), memory_(memory) {
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* at, int key, int, int action, int) {
            if (action == GLFW_PRESS) {
                static_cast<Window*>(glfwGetWindowUserPointer(at))->on_key(key);
            }
        });
        glfwSetCharCallback(window, [](GLFWwindow* at, unsigned character) {
            static_cast<Window*>(glfwGetWindowUserPointer(at))->on_character(character);
        });
        glfwSetWindowRefreshCallback(window, [](GLFWwindow* at) {
            static_cast<Window*>(glfwGetWindowUserPointer(at))->stale_ = true;
        });
        glfwSetFramebufferSizeCallback(window, [](GLFWwindow* at, int, int) {
            static_cast<Window*>(glfwGetWindowUserPointer(at))->stale_ = true;
        });
        glGenTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window() { glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data()); }

    /// Returns when the user or the loop ends it.
    void run() {
        while (glfwWindowShouldClose(window_) == GLFW_FALSE && !loop_is_gone()) {
            const std::uint64_t asked = memory_.asked.load(std::memory_order_relaxed);
            if (memory_.given.load(std::memory_order_acquire) == asked) {
                take_picture();
                memory_.asked.store(asked + 1, std::memory_order_release);
                stale_ = true;
            }
            if (stale_ && frame_.pictures[0].width_px + frame_.pictures[1].width_px > 0) {
                stale_ = false;
                draw();
            }
            glfwWaitEventsTimeout(kPollS);
            if (memory_.takes_presses) {
                gamepads_.take(memory_.presses);
            }
        }
    }

  private:
    void on_character(unsigned character) {
        if (memory_.takes_presses && character < PressedRing::kFirstButton) {
            memory_.presses.add(static_cast<std::uint8_t>(character));
        }
    }

    void on_key(int key) {
        if (memory_.takes_presses && key != GLFW_KEY_ESCAPE) {
            return;  // a character of its own
        }
        switch (key) {
            case GLFW_KEY_ESCAPE:
            case GLFW_KEY_Q:
                glfwSetWindowShouldClose(window_, GLFW_TRUE);
                break;
            case GLFW_KEY_1:
                memory_.eyes = kLeftEye;
                break;
            case GLFW_KEY_2:
                memory_.eyes = kRightEye;
                break;
            case GLFW_KEY_3:
                memory_.eyes = kBothEyes;
                break;
            case GLFW_KEY_F:
                show_ring_ = !show_ring_;
                break;
            case GLFW_KEY_B:
                show_bars_ = !show_bars_;
                break;
            default:
                return;
        }
        stale_ = true;
    }

    void take_picture() {
        const bool first = !shown_;
        frame_ = memory_.frame;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const PreviewPicture& picture = frame_.pictures[e];
            if (picture.width_px == 0) {
                continue;
            }
            glBindTexture(GL_TEXTURE_2D, textures_[e]);
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
            glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
            glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
            // Without alpha: a picture's alpha has no meaning here.
            glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, static_cast<GLsizei>(picture.width_px),
                         static_cast<GLsizei>(picture.height_px), 0,
                         frame_.blue_first ? GL_BGRA : GL_RGBA, GL_UNSIGNED_BYTE,
                         memory_.pixels[e].data());
        }
        glFinish();  // from here on the loop may write the pixels again
        if (first) {
            show_at_picture_size();
        }
        shown_ = true;
        title();
    }

    /// One screen pixel per picture pixel where the picture fits the screen.
    void show_at_picture_size() {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        for (const PreviewPicture& picture : frame_.pictures) {
            width += picture.width_px;
            height = std::max(height, picture.height_px);
        }
        const std::uint32_t fraction = std::max(width, height) / kLargestStartPx + 1;
        const auto side = [&](std::uint32_t px) {
            return std::max(static_cast<int>(px / fraction), kSmallestStartPx);
        };
        glfwSetWindowSize(window_, side(width), side(height));
        glfwShowWindow(window_);
    }

    void title() {
        const bool left = frame_.pictures[0].width_px > 0;
        const bool right = frame_.pictures[1].width_px > 0;
        glfwSetWindowTitle(window_, fmt::format("gazeloop preview: {}, frame {}",
                                                left && right ? "both eyes"
                                                : left        ? "left eye"
                                                              : "right eye",
                                                frame_.index)
                                        .c_str());
    }

    void draw() {
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        draw_pictures();
        if (show_bars_) {
            draw_bars();
        }
        ImGui::Render();
        int width = 0;
        int height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        glViewport(0, 0, width, height);
        glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        glfwSwapBuffers(window_);
    }

    /// Side by side, as large as the window allows without changing their shape, in the middle.
    void draw_pictures() {
        const ImVec2 room = ImGui::GetIO().DisplaySize;
        float width = 0.0F;
        float height = 0.0F;
        for (const PreviewPicture& picture : frame_.pictures) {
            width += static_cast<float>(picture.width_px);
            height = std::max(height, static_cast<float>(picture.height_px));
        }
        const float scale = std::min(room.x / width, room.y / height);
        float x = std::floor((room.x - width * scale) / 2.0F);
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const PreviewPicture& picture = frame_.pictures[e];
            if (picture.width_px == 0) {
                continue;
            }
            const float w = static_cast<float>(picture.width_px) * scale;
            const float h = static_cast<float>(picture.height_px) * scale;
            const float y = std::floor((room.y - h) / 2.0F);
            ImDrawList& list = *ImGui::GetBackgroundDrawList();
            const ImVec2 from(x, y);
            const ImVec2 to(x + w, y + h);
            // NOLINTNEXTLINE(performance-no-int-to-ptr): a texture is a number to OpenGL
            list.AddImage(reinterpret_cast<ImTextureID>(std::uintptr_t{textures_[e]}), from, to);
            if (show_ring_ && picture.ring_radius_px > 0.0F) {
                list.PushClipRect(from, to);
                const ImVec2 fovea(x + picture.fovea_x_px * scale, y + picture.fovea_y_px * scale);
                list.AddCircle(fovea, picture.ring_radius_px * scale, kRing, 64, 2.0F);
                list.PopClipRect();
            }
            x += w;
        }
    }

    void draw_bars() {
        const ImVec2 room = ImGui::GetIO().DisplaySize;
        ImDrawList& list = *ImGui::GetForegroundDrawList();
        const StageBars& bars = frame_.bars;
        const float line = ImGui::GetTextLineHeight() + 2.0F;
        std::array<Legend, 2> legends;
        float height = 3.0F * kMarginPx + line;
        std::size_t colour = 0;
        for (std::size_t i = 0; i < legends.size(); ++i) {
            legends[i] = legend_of(bars.bars[i], room.x - kMarginPx, colour);
            height += static_cast<float>(legends[i].lines) * line + kRowPx + kMarginPx;
        }
        const float top = room.y - height;
        list.AddRectFilled({0.0F, top}, room, kShade);
        if (!bars.any) {
            list.AddText({kMarginPx, top + kMarginPx}, kInk, "no frame has been finished yet");
            return;
        }
        list.AddText({kMarginPx, top + kMarginPx}, kInk,
                     fmt::format("frame {}; white line: budget {:.1f} ms, the display's period",
                                 bars.frame, bars.budget_ms)
                         .c_str());
        const float px_per_ms =
            (room.x - 2.0F * kMarginPx) / static_cast<float>(bar_scale_ms(bars));
        float y = top + kMarginPx + line;
        for (std::size_t i = 0; i < legends.size(); ++i) {
            for (const Words& words : legends[i].words) {
                list.AddText({words.x, y + static_cast<float>(words.line) * line}, words.ink,
                             words.text.c_str());
            }
            y += static_cast<float>(legends[i].lines) * line;
            draw_bar(list, bars.bars[i], legends[i], y, px_per_ms);
            y += kRowPx + kMarginPx;
            const float budget_x = kMarginPx + static_cast<float>(bars.budget_ms) * px_per_ms;
            list.AddLine({budget_x, y - kRowPx - kMarginPx - 3.0F},
                         {budget_x, y - kMarginPx + 3.0F}, kBudget, 2.0F);
        }
    }

    struct Words {
        std::string text;
        ImU32 ink;
        float x;
        std::size_t line;
    };
    /// The title with the total, then each stage in its colour; as many lines as the width needs.
    struct Legend {
        std::vector<Words> words;
        std::size_t lines = 1;
    };

    static Legend legend_of(const StageBar& bar, float right_px, std::size_t& colour) {
        Legend legend;
        float x = kMarginPx;
        const auto add = [&](std::string text, ImU32 ink) {
            const float length = ImGui::CalcTextSize(text.c_str()).x;
            if (x > kMarginPx && x + length > right_px) {
                x = kMarginPx;
                ++legend.lines;
            }
            legend.words.push_back({std::move(text), ink, x, legend.lines - 1});
            x += length;
        };
        const auto duration = [](bool known, double ms) {
            return known ? fmt::format("{:.1f}", ms) : std::string("unknown");
        };
        add(fmt::format("{} {} ms:  ", bar.title.data(), duration(bar.total_known, bar.total_ms)),
            kInk);
        for (std::uint32_t i = 0; i < bar.count; ++i) {
            const BarSegment& segment = bar.segments[i];
            add(fmt::format("{} {}  ", segment.name.data(), duration(segment.known, segment.ms)),
                kColours[colour++ % kColours.size()]);
        }
        return legend;
    }

    static void draw_bar(ImDrawList& list, const StageBar& bar, const Legend& legend, float y,
                         float px_per_ms) {
        float x = kMarginPx;
        for (std::uint32_t i = 0; i < bar.count; ++i) {
            const float length = static_cast<float>(std::max(bar.segments[i].ms, 0.0)) * px_per_ms;
            list.AddRectFilled({x, y + 2.0F}, {x + length, y + kRowPx}, legend.words[i + 1].ink);
            x += length;
        }
    }

    GLFWwindow* window_;
    PreviewMemory& memory_;
    PreviewFrame frame_;
    std::array<GLuint, gaze::kEyeCount> textures_{};
    bool shown_ = false;
    bool stale_ = false;
    Gamepads gamepads_;
    bool show_ring_ = true;
    bool show_bars_ = true;
};

GLFWwindow* open_window() {
    glfwSetErrorCallback(on_error);
    if (glfwInit() == GLFW_FALSE) {
        return nullptr;
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_FALSE);
    return glfwCreateWindow(kSmallestStartPx, kSmallestStartPx, "gazeloop preview", nullptr,
                            nullptr);
}

}  // namespace

int preview_window() {
    std::signal(SIGINT, SIG_IGN);  // Ctrl-C is for the loop, which then closes this window
    void* const mapped = mmap(nullptr, sizeof(PreviewMemory), PROT_READ | PROT_WRITE, MAP_SHARED,
                              kWindowMemoryFd, 0);
    if (mapped == MAP_FAILED) {
        return 2;  // nobody started it as a window
    }
    GLFWwindow* const glfw_window = open_window();
    if (glfw_window == nullptr) {
        say("no window can be opened (" + last_error + ")");
        return 1;
    }
    glfwMakeContextCurrent(glfw_window);
    glfwSwapInterval(1);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    // No callbacks of its own: the window takes the keys.
    if (!ImGui_ImplGlfw_InitForOpenGL(glfw_window, false) ||
        !ImGui_ImplOpenGL3_Init("#version 130")) {
        say("the display's OpenGL cannot draw (3.0 is needed)");
        return 1;
    }
    say(std::string(kWindowIsOpen));
    {
        Window window(glfw_window, *static_cast<PreviewMemory*>(mapped));
        window.run();
    }
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwTerminate();
    return 0;
}

}  // namespace gazeloop::preview
