#include "harness/observe/assembly_quantities.h"

namespace slipcheck {
namespace {

constexpr AssemblyQuantity kQuantities[] = {
    {"height", "m", [](const auto& s) { return s.height; }},
    {"kinetic_energy", "J", [](const auto& s) { return s.kinetic_energy; }},
    {"rotational_energy", "J", [](const auto& s) { return s.rotational_energy; }},
    {"weight_energy", "J", [](const auto& s) { return s.weight_energy; }},
    {"elastic_energy", "J", [](const auto& s) { return s.elastic_energy; }},
    {"contacts", "", [](const auto& s) { return static_cast<double>(s.contacts); }},
    {"coordination", "", [](const auto& s) { return s.coordination; }},
    {"coordination_of_carried", "", [](const auto& s) { return s.coordination_of_carried; }},
    {"pressure", "Pa", [](const auto& s) { return s.pressure(); }},
    {"stress.xx", "Pa", [](const auto& s) { return s.stress(0, 0); }},
    {"stress.yy", "Pa", [](const auto& s) { return s.stress(1, 1); }},
    {"stress.zz", "Pa", [](const auto& s) { return s.stress(2, 2); }},
    {"stress.xy", "Pa", [](const auto& s) { return s.stress(0, 1); }},
    {"stress.xz", "Pa", [](const auto& s) { return s.stress(0, 2); }},
    {"stress.yz", "Pa", [](const auto& s) { return s.stress(1, 2); }},
    {"temperature", "J", [](const auto& s) { return s.temperature; }},
    {"sonine", "", [](const auto& s) { return s.sonine; }},
};

}  // namespace

std::span<const AssemblyQuantity> assembly_quantities() { return kQuantities; }

}  // namespace slipcheck
