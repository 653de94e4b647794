#!/usr/bin/env bash
# lavapipe 22.3.6 (Debian 12's mesa-vulkan-drivers): it calculates in float as if nothing were rounded, so
# what is meant to find or use the rounding finds 0.
#
# The CPU's driver, by which shaders are tested where there is no GPU, does not do the steps that the SPIR-V
# holds. It cancels first: the error of a + b, b - ((a + b) - a), is 0 whatever a and b are (compensated
# sums, two floats for one double); adding and subtracting 1.5 * 2^23 no longer rounds; 3e38 * 10 * 0.1
# does not overflow; (1e30 * 1e-25) * 1e-25 is 0, for 1e-50 is none in float. Infinity - infinity is 0, and
# NaN * 0 too, so that a mask by multiplication and a test for x - x hide what is broken. Vulkan allows it
# (a driver may use what holds for real numbers), a C++ program of the same lines does not do it, and
# drivers differ. isnan() is right. `precise` keeps the steps, but not NaN * 0, which is 0 even so.
# glslc -O does the same before, where a constant is involved: of 11 steps it leaves 4, unless precise.
# State `precise` where a shader handles its own rounding, select instead of multiplying, test by isnan().
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
apt-get download -q glslc=2023.2-1 libshaderc1=2023.2-1 spirv-tools=2023.1-2 \
    mesa-vulkan-drivers=22.3.6-1+deb12u2 libllvm15=1:15.0.6-4+b1 libvulkan1=1.3.239.0-1 \
    libvulkan-dev=1.3.239.0-1 >/dev/null 2>&1
for package in ./*.deb; do
    dpkg-deb -x "$package" root
done
library=$folder/root/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$library
export VK_ICD_FILENAMES=$folder/lavapipe.json
export MESA_SHADER_CACHE_DISABLE=true
printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3"}}\n' \
    "$library/libvulkan_lvp.so" >lavapipe.json

# Runs each shader of its arguments in turn on the floats x, and prints what it then has written to y.
cat >run.cpp <<'CODE'
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>
#include <vulkan/vulkan.h>

namespace {

constexpr float kIn[] = {1e8f, 5.3f, 0.7f, 3e38f, 1e30f, INFINITY, NAN};
constexpr int kCount = 7;

void check(VkResult result) {
    if (result != VK_SUCCESS) {
        std::fprintf(stderr, "Vulkan: %d\n", result);
        std::exit(2);
    }
}

}  // namespace

int main(int, char** arguments) {
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo instance_info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instance_info.pApplicationInfo = &application;
    VkInstance instance{};
    check(vkCreateInstance(&instance_info, nullptr, &instance));
    std::uint32_t count = 1;
    VkPhysicalDevice physical{};
    check(vkEnumeratePhysicalDevices(instance, &count, &physical));
    const float priority = 1;
    VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    VkDeviceCreateInfo device_info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue_info;
    VkDevice device{};
    check(vkCreateDevice(physical, &device_info, nullptr, &device));
    VkQueue queue{};
    vkGetDeviceQueue(device, 0, 0, &queue);

    VkBufferCreateInfo buffer_info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    buffer_info.size = 2 * sizeof kIn;
    buffer_info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkBuffer buffer{};
    check(vkCreateBuffer(device, &buffer_info, nullptr, &buffer));
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    VkMemoryAllocateInfo memory_info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    memory_info.allocationSize = needs.size;  // all of lavapipe's is visible to the host
    VkDeviceMemory memory{};
    check(vkAllocateMemory(device, &memory_info, nullptr, &memory));
    check(vkBindBufferMemory(device, buffer, memory, 0));
    void* mapped{};
    check(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    std::memcpy(mapped, kIn, sizeof kIn);

    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    binding.descriptorCount = 1;
    binding.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set_info.bindingCount = 1;
    set_info.pBindings = &binding;
    VkDescriptorSetLayout set_layout{};
    check(vkCreateDescriptorSetLayout(device, &set_info, nullptr, &set_layout));
    VkPipelineLayoutCreateInfo layout_info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout_info.setLayoutCount = 1;
    layout_info.pSetLayouts = &set_layout;
    VkPipelineLayout layout{};
    check(vkCreatePipelineLayout(device, &layout_info, nullptr, &layout));
    const VkDescriptorPoolSize pool_size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
    VkDescriptorPoolCreateInfo sets_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    sets_info.maxSets = sets_info.poolSizeCount = 1;
    sets_info.pPoolSizes = &pool_size;
    VkDescriptorPool sets{};
    check(vkCreateDescriptorPool(device, &sets_info, nullptr, &sets));
    VkDescriptorSetAllocateInfo allocate_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate_info.descriptorPool = sets;
    allocate_info.descriptorSetCount = 1;
    allocate_info.pSetLayouts = &set_layout;
    VkDescriptorSet set{};
    check(vkAllocateDescriptorSets(device, &allocate_info, &set));
    const VkDescriptorBufferInfo whole{buffer, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &whole;
    vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
    VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandPool pool{};
    check(vkCreateCommandPool(device, &pool_info, nullptr, &pool));

    while (*++arguments != nullptr) {
        std::ifstream file(*arguments, std::ios::binary);
        const std::vector<char> code(std::istreambuf_iterator<char>(file), {});
        VkShaderModuleCreateInfo module_info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
        module_info.codeSize = code.size();
        module_info.pCode = reinterpret_cast<const std::uint32_t*>(code.data());
        VkComputePipelineCreateInfo pipeline_info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
        pipeline_info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        check(vkCreateShaderModule(device, &module_info, nullptr, &pipeline_info.stage.module));
        pipeline_info.stage.pName = "main";
        pipeline_info.layout = layout;
        VkPipeline pipeline{};
        check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &pipeline));
        VkCommandBufferAllocateInfo command_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        command_info.commandPool = pool;
        command_info.commandBufferCount = 1;
        VkCommandBuffer commands{};
        check(vkAllocateCommandBuffers(device, &command_info, &commands));
        VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(commands, &begin));
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
        vkCmdDispatch(commands, 1, 1, 1);
        check(vkEndCommandBuffer(commands));
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands;
        check(vkQueueSubmit(queue, 1, &submit, nullptr));
        check(vkQueueWaitIdle(queue));
        for (int i = 0; i < kCount; ++i) {
            const float written = static_cast<float*>(mapped)[kCount + i];
            if (i < 6) std::printf("%s%g", i == 0 ? "" : " ", std::isnan(written) ? NAN : written);
        }
        std::printf("\n");
    }
    std::fflush(stdout);
    std::_Exit(0);
}
CODE
g++ -std=c++17 -O1 -Iroot/usr/include run.cpp -o run "$library/libvulkan.so.1"

# shader QUALIFIER: six expressions of x, each step kept in a variable of that qualifier.
shader() {
    cat <<GLSL
#version 450
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer B { float x[7]; float y[7]; };
void main() {
    $1 float sum = x[0] + x[1];
    $1 float difference = sum - x[0];
    $1 float error = x[1] - difference;
    $1 float rounded = (x[2] + 12582912.0) - 12582912.0;
    $1 float over = (x[3] * 10.0) * 0.1;
    $1 float under = (x[4] * 1e-25) * 1e-25;
    $1 float none = x[5] - x[5];
    $1 float masked = x[6] * 0.0;
    y[0] = error; y[1] = rounded; y[2] = over; y[3] = under; y[4] = none; y[5] = masked;
}
GLSL
}
shader '' >plain.comp
shader precise >precise.comp
steps() { root/usr/bin/spirv-dis --no-color "$1" | grep -cE ' OpF(Add|Sub|Mul) '; }
root/usr/bin/glslc -O0 plain.comp -o plain.spv
root/usr/bin/glslc -O plain.comp -o optimised.spv
root/usr/bin/glslc -O0 precise.comp -o precise.spv
root/usr/bin/glslc -O precise.comp -o precise-optimised.spv

# The same lines in C++, step by step.
cat >same.cpp <<'CODE'
#include <cmath>
#include <cstdio>

int main() {
    const volatile float x[] = {1e8f, 5.3f, 0.7f, 3e38f, 1e30f, INFINITY, NAN};
    const float sum = x[0] + x[1];
    const float difference = sum - x[0];
    const float error = x[1] - difference;
    const float rounded = (x[2] + 12582912.0f) - 12582912.0f;
    const float over = (x[3] * 10.0f) * 0.1f;
    const float under = (x[4] * 1e-25f) * 1e-25f;
    const float none = x[5] - x[5];
    const float masked = x[6] * 0.0f;
    std::printf("%g %g %g %g %g %g\n", double(error), double(rounded), double(over), double(under),
                std::isnan(none) ? NAN : double(none), std::isnan(masked) ? NAN : double(masked));
    return 0;
}
CODE
g++ -std=c++17 -O2 same.cpp -o same

unexpected=0
expect() { # expect WHAT STEPS FOUND STATED
    # shellcheck disable=SC2086  # one word for each column
    printf '%-18s %5s  %11s %9s %12s %20s %9s %6s\n' "$1" "$2" $3
    [[ "$2 $3" == "$4" ]] || unexpected=1
}
printf '%-18s %5s  %11s %9s %12s %20s %9s %6s\n' '' steps 'error(a+b)' '0.7+c-c' '3e38*10*.1' \
    '1e30*1e-25*1e-25' 'inf-inf' 'NaN*0'
expect 'C++' 11 "$(./same)" '11 -2.7 1 inf 1e-20 nan nan'
for which in plain optimised precise precise-optimised; do
    case $which in
        plain) stated='11 0 0.7 3e+38 0 0 0' ;;
        optimised) stated='4 0 0.7 3e+38 0 0 0' ;;
        *) stated='11 -2.7 1 inf 1e-20 nan 0' ;;
    esac
    expect "$which" "$(steps "$which.spv")" "$(./run "$which.spv")" "$stated"
done
if ((unexpected)); then
    echo 'NOT as stated: this finding is out of date'
    exit 1
fi
echo 'as stated'
