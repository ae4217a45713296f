// SPDX-License-Identifier: GPL-3.0-or-later
#include <rapidcheck.h>

#include <array>
#include <catch2/catch.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "studio/page_words.h"
#include "studio/replay.h"
#include "studio/session.h"
#include "tests/studio/failing_disk.h"
#include "tests/studio/visitor.h"

namespace furrow {
namespace {

using jobs::Json;
using tests::Desk;

/// What a page would hear and see.
struct Ear : studio::Outbox {
  void tell(studio::Client, const Json& message) override {
    if (message.contains("status")) status = message["status"];
    if (message.contains("id")) answer = message;
  }
  void show(studio::Client, studio::Bytes frame) override {
    if (frame->at(4) == 0) cloth = *frame;
  }
  Json status, answer;
  std::string cloth;
};

/// A session without a server, what it says, and what its history should be.
class Play {
 public:
  explicit Play(const Desk& desk) : folder_(desk.project()) {
    session_.emplace(desk.scene, folder_, ear_);
    drawings_.push_back(drawing());
    start_ = session_->shape_bits();
    session_->greet(1);
  }

  /// `share`: of the disk's calls that fail meanwhile.
  Json ask(const Json& body, double share = 0, std::uint64_t seed = 0) {
    const Json before = drawing();
    const std::string cloth = ear_.cloth;
    ear_.answer = nullptr;
    session_->allow();
    {
      const tests::FailingDisk disk(share, seed);
      session_->handle(1, {"x", body.value("do", ""), body});
      failed_ += disk.failed();
    }
    RC_ASSERT(ear_.answer.is_object());
    RC_ASSERT(ear_.answer.at("id") == "x");
    check(body, before, cloth);
    return ear_.answer;
  }

  /// Ends, and goes on with what is on the disk: all that was acknowledged, and nothing else.
  void open_again() {
    const std::string shape = session_->shape_bits(), redo = session_->project().next_redo();
    session_.reset();
    session_.emplace(folder_, ear_);
    session_->greet(1);
    RC_ASSERT(session_->project().at() == at_);
    RC_ASSERT(session_->project().count() == drawings_.size());
    RC_ASSERT(drawing() == drawings_[at_]);
    RC_ASSERT(session_->project().next_redo() == redo);
    RC_ASSERT(session_->project().log() == acknowledged_);
    RC_ASSERT(session_->shape_bits() == shape);
  }

  void undo_all() {
    while (at_ > 0) RC_ASSERT(ask({{"do", "undo"}}).contains("done"));
    RC_ASSERT(drawing() == drawings_[0]);
    RC_ASSERT(session_->shape_bits() == start_);
  }
  void redo_all() {
    while (at_ + 1 < drawings_.size()) RC_ASSERT(ask({{"do", "redo"}}).contains("done"));
  }
  std::size_t lines() const { return drawing().at("lines").size(); }
  int failed() const { return failed_; }  ///< calls of the disk

 private:
  Json drawing() const { return session_->project().now().drawing; }

  /// The model: a list of drawings, and a place in it.
  void check(const Json& body, const Json& before, const std::string& cloth) {
    const std::string what = body.value("do", "");
    const bool done = ear_.answer.contains("done");
    if (!done) {
      RC_ASSERT(ear_.answer.at("refused").get<std::string>().size() > 5);
      RC_ASSERT(drawing() == before);
      RC_ASSERT(ear_.cloth == cloth);
    } else if (what == "undo") {
      --at_;
    } else if (what == "redo") {
      ++at_;
    } else if (session_->project().at() != at_) {
      RC_ASSERT(session_->project().at() == at_ + 1);
      drawings_.resize(++at_);
      drawings_.push_back(drawing());
    }
    const std::vector<Json> log = session_->project().log();
    if (log.size() > acknowledged_.size()) {
      RC_ASSERT(done);
      RC_ASSERT(log.size() == acknowledged_.size() + 1);
      RC_ASSERT(log.back().at("do") == what);
      acknowledged_.push_back(log.back());
    }
    RC_ASSERT(log == acknowledged_);
    RC_ASSERT(session_->project().at() == at_);
    RC_ASSERT(session_->project().count() == drawings_.size());
    RC_ASSERT(drawing() == drawings_[at_]);
    RC_ASSERT(ear_.status.at("step") == at_);
    RC_ASSERT(ear_.status.at("lines").size() == drawing().at("lines").size());
    RC_ASSERT(ear_.status.at("undo").get<std::string>().empty() == (at_ == 0));
  }

  const std::filesystem::path folder_;
  Ear ear_;
  std::optional<studio::Session> session_;
  std::vector<Json> drawings_, acknowledged_;
  int failed_ = 0;
  std::size_t at_ = 0;
  std::string start_;
};

/// Something that a page might ask, mostly what can be done.
Json any_intention(std::mt19937_64& random, std::size_t lines) {
  const auto share = [&] { return double(random() >> 11) * 0x1p-53; };
  const auto in = [&](double low, double high) { return low + (high - low) * share(); };
  const auto one = [&](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
  const std::size_t line = one(lines + (share() < 0.1 ? 2 : 0));
  const double x = in(-0.16, 0.16);
  const Json points{{x, in(0.05, 0.12), 0.0}, {x + in(-0.03, 0.03), 0.2, 0.0}, {x, in(0.25, 0.33), 0.0}};
  const std::vector<std::function<Json()>> all{
      [&] {
        return Json{
            {"do", "draw"}, {"height", in(-0.02, 0.02)}, {"width", in(0.03, 0.1)}, {"points", points}};
      },
      [&] {
        return Json{{"do", "draw"}, {"height", in(0, 0.02)}, {"mirror", share() < 0.5}, {"points", points}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"height", in(-0.03, 0.03)}, {"live", share() < 0.3}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"on", share() < 0.5}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"sharpness", in(-0.1, 1.1)}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"width", share() < 0.3 ? Json() : Json(in(0, 0.2))}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"press", in(0.5, 100)}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"points", points}};
      },
      [&] {
        return Json{{"do", "set"}, {"line", line}, {"name", "n" + std::to_string(one(5))}};
      },
      [&] {
        return Json{{"do", "delete"}, {"line", line}};
      },
      [&] {
        return Json{{"do", "duplicate"}, {"line", line}};
      },
      [&] {
        return Json{{"do", "mirror"}, {"line", line}};
      },
      [&] {
        return Json{{"do", "move"}, {"line", line}, {"to", one(lines)}};
      },
      [&] {
        return Json{{"do", "middle"}, {"x", in(-0.1, 0.1)}};
      },
      [&] {
        return Json{{"do", "pin"}, {"at", {in(-0.2, 0.2), in(0, 0.4), 0.0}}};
      },
      [&] {
        return Json{{"do", "hold"}, {"border", 0}, {"on", share() < 0.5}};
      },
      [&] {
        return Json{{"do", "wind"}, {"velocity", {in(-5, 5), 0.0, in(-5, 5)}}};
      },
      [&] {
        return Json{{"do", "fabric"}, {"name", share() < 0.5 ? "denim" : "silk"}};
      },
      [&] {
        return Json{{"do", share() < 0.7 ? "undo" : "redo"}};
      },
      [&] {
        return Json{{"do", share() < 0.7 ? "undo" : "redo"}};
      },
      [&] {
        return Json{{"do", share() < 0.3 ? "save" : "tangles"}};
      },
      [&] {
        return Json{{"do", "points"}, {"line", line}};
      },
      [&] {
        const char* const kind = std::array{"iron", "steam", "pinch"}[one(3)];
        return Json{{"do", "touch"}, {"touch", {{kind, {x, 0.2, 0.0}}, {"radius", in(0, 0.2)}}}};
      },
      [&] {
        return Json{{"do", "fit"}, {"by", "strain"}};
      },
      [&] {
        if (share() > 0.3) return Json{{"do", "undo"}};
        return Json{{"do", "play"}, {"seconds", 1 / 60.0}};
      }};
  return all[one(all.size())]();
}

/// Asks for so much on a disk that fails at times, opens it again at times, undoes it all, does it all again,
/// and replays the log: it ends in the bits of what was acknowledged. Returns how often the disk failed.
int do_at_random(std::uint64_t seed, int intentions, const std::string& name) {
  const Desk desk(name);
  std::mt19937_64 random(seed);
  int failed = 0;
  {
    Play play(desk);
    for (int i = 0; i < intentions; ++i) {
      const Json body = any_intention(random, play.lines());
      const double share = random() % 2 ? 0.3 * double(random() % 100) / 100 : 0;
      play.ask(body, share, random());
      if (random() % 20 == 0) play.open_again();
    }
    play.undo_all();
    play.redo_all();
    play.open_again();
    failed = play.failed();
  }
  const auto report = studio::replay(desk.project(), desk.folder / "again", [](auto, auto) { return true; });
  RC_ASSERT(report.difference == "");
  return failed;
}

}  // namespace

TEST_CASE("studio protocol: messages name what the page has, and leave out advice for other faces") {
  CHECK(studio::in_page(
            "3 pairs cross; cloth has no contact with cloth here: `self_contact=on` keeps it apart, or "
            "accept them with `allow_crossings=3`") ==
        "3 pairs cross; Tangles (T) shows where, Undo takes it back");
  CHECK(studio::in_page("swings; `furrow keep` finds out which lines hold") ==
        "swings; Keep finds out which lines hold");
  CHECK(studio::in_page("not at rest; give more with `max_iterations`; look at `unit`") ==
        "not at rest; look at Unit");
  CHECK(studio::in_page("`cloth_thickness` is no number; say so") == "cloth_thickness is no number; say so");
}

TEST_CASE(
    "studio protocol: random intentions on a failing disk are done or refused, undone to the start, and "
    "replayed to "
    "the bits of what was acknowledged",
    "[long]") {
  int runs = 0;  // each takes half a second: the first twenty of the cases that are asked for
  CHECK(rc::check([&runs] {
    if (runs++ < 20) do_at_random(*rc::gen::arbitrary<std::uint64_t>(), 12, "random");
  }));
}

TEST_CASE("studio protocol: hundreds of random intentions are, too", "[release][long]") {
  std::mt19937_64 seeds(22);
  constexpr int runs = FURROW_PROPERTY_CASES / 50;
  int failed = 0;
  for (int i = 0; i < runs; ++i) {
    const std::uint64_t seed = seeds();
    INFO(seed);
    CHECK_NOTHROW(failed += do_at_random(seed, 50, "hundreds"));
  }
  CHECK(failed > 5 * runs);
}

}  // namespace furrow
