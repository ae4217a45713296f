// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/follow.h"

#include "cli/card_options.h"
#include "cli/common.h"
#include "cli/subcommands.h"

namespace furrow::cli {
namespace {

struct FollowArguments : CommonArguments {
  std::string garment;
  FollowJob job;
};

/// Keys with what they do worst, the worst ones by name.
Lines follow_lines(const Json& report) {
  const Json& keys = list_of(report, "keys");
  const Json *farthest = &keys.front(), *deepest = &keys.front();
  for (const Json& key : keys) {
    if (value_of(key, "farthest") > value_of(*farthest, "farthest")) farthest = &key;
    if (value_of(key, "poke_at_full") > value_of(*deepest, "poke_at_full")) deepest = &key;
  }
  Lines lines{counted(keys.size(), "shape key") + ": the farthest moves the garment by " +
              length(*farthest, "farthest") + " ('" + text_of(*farthest, "name") + "')"};
  lines.push_back("the body comes through by " + length(*deepest, "poke_at_full") +
                  " more than without, at most ('" + text_of(*deepest, "name") + "')");
  if (const Json& made = list_of(report, "correctives"); !made.empty())
    lines.push_back(counted(made.size(), "corrective key") + ", such as '" + text_of(made.front(), "name") +
                    "': show it by the product of both");
  if (const long long mixes = count_of(report, "mixes"))
    lines.push_back(std::to_string(mixes) + " random mixtures: the body comes through by " +
                    length(report, "mixes_p50") + " in half of them, " + length(report, "mixes_p99") +
                    " in one of a hundred, " + length(report, "mixes_most") + " at most");
  return lines;
}

void follow(FollowArguments& a) {
  a.job.garment = std::filesystem::path(a.garment);
  a.job.frame = a;
  a.out = a.job.output.string();
  Terminal terminal(a);
  const FollowReport report = jobs::follow(a.job, terminal);
  Json json = to_json(report);
  json["written"] = a.out;
  print_report(json, a, {follow_lines(json), {a.out}});
}

void add_follow(CLI::App& sub, FollowArguments& a) {
  sub.add_option("garment", a.garment, "mesh that fits the body")->required();
  add_card(sub, card(a.job));
  sub.get_option("--body")->required();
  sub.get_option("--output")->required();
}

const Subcommand follow_subcommand(
    165, "follow",
    "Give a garment the shape keys of its body, so that it goes along\n\n"
    "The garment gets a key of the same name for each of the body's, which moves it with the skin below and\n"
    "keeps it out of the body; pairs of keys that come through together get a corrective key, A*B. Then "
    "random\n"
    "mixtures are tried, and what comes through is reported.\n\n"
    "  furrow follow avatar.glb#Shirt --body avatar.glb#Body -o follows.glb\n"
    "  furrow follow shirt.obj --body anna.obj --body-keys heavy.obj --body-keys tall.obj -o shirt.glb",
    add_follow, follow);

}  // namespace
}  // namespace furrow::cli
