#pragma once

#include <linux/usb/ch9.h>
#include <pthread.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace gazeloop::tests {

/// A USB device on the kernel's dummy host controller, plugged in for as long as it exists. It is
/// made through GadgetFS, which hands it every request that the host sends: FunctionFS keeps back
/// those that are addressed to endpoint 0, and a PSVR2 is asked for gaze so.
class UsbGadget {
  public:
    using Bytes = std::vector<std::uint8_t>;
    struct Device {
        Bytes descriptor;           ///< of the device
        Bytes configuration;        ///< the only one, with what belongs to it
        Bytes endpoint;             ///< descriptor of the one that it sends through
        std::string endpoint_file;  ///< GadgetFS's name for one that the controller can give it
        /// What the device answers to a request; none refuses it. `data` is what came with it.
        std::function<std::optional<Bytes>(const usb_ctrlrequest&, std::span<const std::uint8_t>)>
            answer;
        /// Whether the host wants data. Where it does not, a send that waits is given up, so that
        /// the host finds nothing old when it wants some again.
        std::function<bool()> wanted;
    };

    /// `folder` is where GadgetFS is mounted; the thread that makes it is the one that sends, and
    /// gets SIGUSR1 when it is to give up. Throws std::runtime_error.
    UsbGadget(const std::string& folder, Device device);
    UsbGadget(const UsbGadget&) = delete;
    UsbGadget& operator=(const UsbGadget&) = delete;
    ~UsbGadget();

    /// Sends through the endpoint; waits until the host fetches it. False: it did not (it has not
    /// configured the device, wants no data, or a signal came).
    [[nodiscard]] bool send(std::span<const std::uint8_t> data) const;

  private:
    void serve();
    void answer(const usb_ctrlrequest& request);
    void open_endpoint();

    std::string folder_;
    Device device_;
    pthread_t sender_;
    int control_ = -1;
    std::atomic<int> endpoint_{-1};
    std::atomic<bool> stop_{false};
    std::thread thread_;  // last: it uses the others
};

}  // namespace gazeloop::tests
