#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "engine/npm_engines.h"

namespace slipcheck {

/// An engine cannot be installed or removed; the message says why and what to do.
class NotInstalled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An engine in one version.
struct NpmChoice {
  NpmEngine engine;
  std::string version;
  std::string name() const { return engine.name + "@" + version; }
};

/// What "rapier@0.19.3" means, or "rapier" for its usual version. Throws NotInstalled for an engine
/// that does not come through npm and for what is no version.
NpmChoice npm_choice(const std::string& name);

/// Has npm put the packages of an engine in a folder of engines_folder() of their own: in exactly
/// this version, running no script of theirs, by the lock file that lies beside the workers where
/// there is one. Starts the worker once; the folder appears only when that has answered, and stays
/// as it is where it is there already. Returns what was found. Throws NotInstalled.
EngineExecutable install_engine(const NpmChoice& choice);

/// Throws NotInstalled where it is not there.
void remove_engine(const NpmChoice& choice);

}  // namespace slipcheck
