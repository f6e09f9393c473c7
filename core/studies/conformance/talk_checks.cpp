// What is said, and how it ends.

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "engine/scene_json.h"
#include "studies/conformance/checks.h"
#include "studies/conformance/trial_scenes.h"

namespace slipcheck {
namespace {

using nlohmann::json;

constexpr double kPatience = 5;                       // for an exit [s]
constexpr std::chrono::milliseconds kAfterReply{20};  // in which stray output shows

/// An executable whose name says what it is must say the same.
void expect_own_name(const std::string& file, const std::string& engine,
                     const std::string& precision) {
  if (!file.starts_with("slipcheck-engine-")) return;
  const std::string own = fmt::format("slipcheck-engine-{}-{}", engine, precision);
  const std::size_t version = file.find('@');
  const bool same = version == std::string::npos
                        ? file == own
                        : file.starts_with(fmt::format("slipcheck-engine-{}@", engine)) &&
                              file.ends_with("-" + precision);
  if (!same)
    throw Breach(
        fmt::format("it greets as {} in {} precision, which is {}", engine, precision, own));
}

std::string greeting(const Trial& trial) {
  WorkerProcess worker = trial.process();
  const json reply = ask(worker, hello_request());
  const auto text = [&](const char* key) {
    if (!reply.contains(key) || !reply[key].is_string() || reply[key].get<std::string>().empty())
      throw Breach(fmt::format("the welcome has no text \"{}\"", key));
    return reply[key].get<std::string>();
  };
  if (text("type") != "welcome")
    throw Breach(fmt::format("hello is answered with \"{}\"", text("type")));
  if (!reply.contains("protocol") || reply["protocol"] != protocol::kVersion)
    throw Breach(fmt::format("the protocol is {}, not {}", reply.value("protocol", json()).dump(),
                             protocol::kVersion));
  const std::string engine = text("engine"), version = text("version"),
                    precision = text("precision");
  if (precision != "single" && precision != "double")
    throw Breach(fmt::format("the precision is \"{}\"", precision));
  expect_own_name(trial.executable().program.filename().string(), engine, precision);
  return fmt::format("{} {}, {} precision", engine, version, precision);
}

std::string settings_table(const Trial& trial) {
  WorkerProcess worker = trial.process();
  const protocol::Bytes body = worker.exchange(message_of(hello_request()));
  try {
    const protocol::Reply reply = protocol::decode_reply(body);
    const auto* welcome = std::get_if<protocol::Welcome>(&reply);
    if (welcome == nullptr) throw NotJudged("there is no welcome");
    return fmt::format("{} settings", welcome->info.settings.size());
  } catch (const protocol::Rubbish& rubbish) {
    throw Breach(rubbish.what());
  }
}

std::string nothing_unasked(const Trial& trial) {
  WorkerProcess worker = trial.process();
  const Scene scene = one_sphere(0);
  const auto say = [&](const char* name, const json& request) {
    std::string type = reply_type(worker, request);
    std::this_thread::sleep_for(kAfterReply);
    if (const std::size_t bytes = worker.unread())
      throw Breach(fmt::format("{} bytes follow the reply to {}", bytes, name));
    return type;
  };
  say("hello", hello_request());
  if (say("configure", configure_request(scene)) == "configured") {
    say("start", start_request(scene.initial));
    say("step", step_request(20));
  }
  return {};
}

std::string unknown_request(const Trial& trial) {
  WorkerProcess worker = trial.process();
  const json reply = ask(worker, {{"type", "no_such_request"}});
  if (reply["type"] != "failed")
    throw Breach(fmt::format("it is answered with \"{}\", not with \"failed\"",
                             reply["type"].get<std::string>()));
  if (!reply.contains("reason") || !reply["reason"].is_string())
    throw Breach("\"failed\" has no text \"reason\"");
  return reply["reason"].get<std::string>();
}

std::string unknown_keys(const Trial& trial) {
  WorkerProcess worker = trial.process();
  json hello = hello_request();
  hello["of_a_later_version"] = {{"list", {1, 2.5, "text", true}}, {"map", json::object()}};
  const std::string type = reply_type(worker, hello);
  if (type != "welcome") throw Breach(fmt::format("hello with one is answered with \"{}\"", type));
  return {};
}

/// Integers where the protocol speaks of numbers, and floats that fit into 16, 32 and 64 bits.
std::string numbers_of_any_width(const Trial& trial) {
  Scene scene = one_sphere(0);
  json request = configure_request(scene);
  request["scene"]["gravity"] = 10;
  request["scene"]["bodies"][0]["mass"] = 1;
  request["scene"]["bodies"][0]["radius"] = 0.125;
  request["scene"]["bodies"][0]["shape_factor"] = 0.4;
  request["scene"]["substrate"][0]["kinetic_friction"] = 0;
  scene.initial[0].position.z() = 0.125;
  WorkerProcess worker = trial.process();
  reply_type(worker, hello_request());
  const std::string type = reply_type(worker, request);
  if (type == "refused") throw NotJudged("the engine refuses the scene");
  if (type != "configured") throw Breach(fmt::format("configure is answered with \"{}\"", type));
  json start = start_request(scene.initial);
  start["time"] = 0;
  for (const auto& [each, expected] : {std::pair{start, "started"}, {step_request(1), "frames"}})
    if (const std::string got = reply_type(worker, each); got != expected)
      throw Breach(
          fmt::format("an integer is not taken for a number: \"{}\", not \"{}\"", got, expected));
  return {};
}

void expect_failed(WorkerProcess& worker, const char* what, const json& request) {
  const std::string type = reply_type(worker, request);
  if (type != "failed" && type != "refused")
    throw Breach(fmt::format("{} is answered with \"{}\"", what, type));
}

std::string out_of_order(const Trial& trial) {
  const Scene one = one_sphere(0), two = spheres_on_plane(2);
  {
    WorkerProcess worker = trial.process();
    reply_type(worker, hello_request());
    expect_failed(worker, "start before configure", start_request(one.initial));
  }
  {
    WorkerProcess worker = trial.process();
    reply_type(worker, hello_request());
    if (reply_type(worker, configure_request(one)) != "configured")
      throw NotJudged("the engine refuses the scene");
    expect_failed(worker, "step before start", step_request(1));
  }
  WorkerProcess worker = trial.process();
  reply_type(worker, hello_request());
  reply_type(worker, configure_request(one));
  expect_failed(worker, "start with a state too many", start_request(two.initial));
  return {};
}

std::string end_well(const WorkerEnd& end, const char* after) {
  if (!end.exited)
    throw Breach(fmt::format("after {} it still runs {:g} s later", after, kPatience));
  if (!end.well) throw Breach(fmt::format("after {} it {}", after, end.how));
  if (end.left_over > 0)
    throw Breach(fmt::format("after {} it still writes {} bytes", after, end.left_over));
  return {};
}

std::string quit(const Trial& trial) {
  WorkerProcess worker = trial.process();
  reply_type(worker, hello_request());
  return end_well(worker.finish(message_of({{"type", "quit"}}), false, kPatience), "quit");
}

std::string end_of_input(const Trial& trial) {
  WorkerProcess idle = trial.process();
  reply_type(idle, hello_request());
  end_well(idle.finish({}, true, kPatience), "the end of its input");
  WorkerProcess listening = trial.process();
  reply_type(listening, hello_request());
  protocol::Bytes half = message_of(step_request(1));
  half.resize(half.size() / 2);
  return end_well(listening.finish(half, true, kPatience), "an input that ends in a message");
}

}  // namespace

std::vector<Check> talk_checks() {
  return {
      {"greeting",
       "Answer hello with {type: \"welcome\", protocol: as in hello, engine, version, precision, "
       "settings}, "
       "behind a length of four bytes, little-endian. Engine and precision are those of the "
       "executable's name, slipcheck-engine-<engine>-<precision>.",
       greeting},
      {"settings table",
       "Each of the welcome's settings has name, about, unit, shipped, whole, choices and "
       "candidates, and keeps to its own limits; [] where there are no settings.",
       settings_table},
      {"nothing unasked",
       "Write one reply to each request and nothing else. Give the replies a copy of descriptor 1 "
       "and point 1 at 2 before anything prints; flush after each reply.",
       nothing_unasked},
      {"unknown request", "Answer what you do not know with {type: \"failed\", reason: text}.",
       unknown_request},
      {"unknown keys", "Pass over keys that you do not know: later versions add some.",
       unknown_keys},
      {"numbers of any width",
       "Take CBOR integers and floats of 16, 32 and 64 bits wherever a number is asked for.",
       numbers_of_any_width},
      {"requests out of order",
       "Answer start before configure, step before start and a wrong number of states with "
       "{type: \"failed\", reason: text}.",
       out_of_order},
      {"quit", "Exit with code 0 on quit, without a reply.", quit},
      {"end of input",
       "Exit with code 0 when the input ends, in the middle of a message too: the harness is gone.",
       end_of_input},
  };
}

}  // namespace slipcheck
