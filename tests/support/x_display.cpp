#include "tests/support/x_display.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace gazeloop::tests {
namespace {

constexpr int kPatienceMs = 30'000;
constexpr int kStepMs = 20;

void wait_a_little() { poll(nullptr, 0, kStepMs); }

}  // namespace

XServer::XServer() {
    std::array<int, 2> number{};
    if (pipe(number.data()) != 0) {
        throw std::runtime_error("no pipe");
    }
    pid_ = fork();
    if (pid_ == 0) {
        const int nothing = open("/dev/null", O_RDWR);
        dup2(nothing, STDOUT_FILENO);
        dup2(nothing, STDERR_FILENO);
        ::close(number[0]);
        const std::string descriptor = std::to_string(number[1]);
        execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1000x800x24",
               "-nolisten", "tcp", nullptr);
        _exit(127);
    }
    ::close(number[1]);
    // A number and the end of its line, not always at once.
    std::string line;
    for (char one = 0; read(number[0], &one, 1) == 1 && one != '\n';) {
        line += one;
    }
    ::close(number[0]);
    name_ = line.empty() ? "" : ":" + line;
}

void XServer::end() {
    if (pid_ > 0) {
        kill(pid_, SIGTERM);  // it then takes its lock and socket away
        waitpid(pid_, nullptr, 0);
        pid_ = -1;
    }
}

SeenWindow::SeenWindow(const XServer& server) : display_(XOpenDisplay(server.name().c_str())) {
    if (display_ == nullptr) {
        throw std::runtime_error("no connection to the X server");
    }
    // The window may go while it is looked at.
    XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
}

SeenWindow::~SeenWindow() { XCloseDisplay(display_); }

std::string SeenWindow::find(const std::string& part) {
    Window root = 0;
    Window parent = 0;
    Window* windows = nullptr;
    unsigned count = 0;
    std::string found;
    XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &windows, &count);
    for (unsigned i = 0; i < count && found.empty(); ++i) {
        char* title = nullptr;
        XWindowAttributes attributes{};
        if (XFetchName(display_, windows[i], &title) != 0 &&
            XGetWindowAttributes(display_, windows[i], &attributes) != 0 &&
            attributes.map_state == IsViewable &&
            std::string(title).find(part) != std::string::npos) {
            found = title;
            window_ = windows[i];
        }
        if (title != nullptr) {
            XFree(title);
        }
    }
    if (windows != nullptr) {
        XFree(windows);
    }
    return found;
}

std::string SeenWindow::wait_for_title(const std::string& part) {
    for (int waited_ms = 0; waited_ms < kPatienceMs; waited_ms += kStepMs) {
        if (std::string title = find(part); !title.empty()) {
            return title;
        }
        wait_a_little();
    }
    return "";
}

Screenshot SeenWindow::screenshot() const {
    XWindowAttributes attributes{};
    XGetWindowAttributes(display_, window_, &attributes);
    Screenshot shot{attributes.width, attributes.height, {}};
    XImage* const image = XGetImage(display_, window_, 0, 0, static_cast<unsigned>(shot.width),
                                    static_cast<unsigned>(shot.height), AllPlanes, ZPixmap);
    for (int y = 0; y < shot.height; ++y) {
        for (int x = 0; x < shot.width; ++x) {
            const unsigned long pixel = XGetPixel(image, x, y);
            shot.pixels.push_back({static_cast<std::uint8_t>(pixel >> 16U),
                                   static_cast<std::uint8_t>(pixel >> 8U),
                                   static_cast<std::uint8_t>(pixel)});
        }
    }
    XDestroyImage(image);
    return shot;
}

void SeenWindow::press(char key) {
    XEvent event{};
    // An input method hands keys on a second time; GLFW tells that by their time.
    event.xkey.time = ++key_time_;
    event.xkey.display = display_;
    event.xkey.window = window_;
    event.xkey.root = DefaultRootWindow(display_);
    event.xkey.same_screen = True;
    event.xkey.keycode = XKeysymToKeycode(display_, static_cast<KeySym>(key));
    event.xkey.type = KeyPress;
    XSendEvent(display_, window_, True, KeyPressMask, &event);
    event.xkey.type = KeyRelease;
    XSendEvent(display_, window_, True, KeyReleaseMask, &event);
    XSync(display_, False);
}

void SeenWindow::resize(int width, int height) const {
    XResizeWindow(display_, window_, static_cast<unsigned>(width), static_cast<unsigned>(height));
    XSync(display_, False);
}

void SeenWindow::close() const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window_;
    event.xclient.message_type = XInternAtom(display_, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(XInternAtom(display_, "WM_DELETE_WINDOW", False));
    event.xclient.data.l[1] = CurrentTime;
    XSendEvent(display_, window_, False, NoEventMask, &event);
    XSync(display_, False);
}

}  // namespace gazeloop::tests
