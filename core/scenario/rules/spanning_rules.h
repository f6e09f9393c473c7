#pragma once

#include <string>

#include "scenario/reading.h"
#include "scenario/written_scene.h"

namespace slipcheck {

// The rules that span several keys, each once. They look only at what was read without a fault.

/// "substrate", "floor", "wall", "lid" and "all" name no material or body.
bool is_reserved_name(const std::string& name);

/// Names of materials and bodies: none reserved, twice or ambiguous, all materials known.
void check_names(const WrittenScene& written, Reading& reading);

/// A contact for all that may meet, none twice, each with what its model needs (contact_check.cpp).
void check_contacts(const WrittenScene& written, Reading& reading);

void check_surroundings(const WrittenScene& written, Reading& reading);

void check_run(const WrittenScene& written, Reading& reading);

/// What is expected of engines, and tolerances that name an owner, are of bodies and pairs that
/// there are (owner_check.cpp).
void check_expectations(const WrittenScene& written, Reading& reading);
void check_tolerances(const WrittenScene& written, Reading& reading);

}  // namespace slipcheck
