// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/card.h"
#include "jobs/chain/keep.h"

namespace furrow::jobs {

std::vector<CardRow> card(KeepJob& job) {
  using enum Group;
  using enum Audience;
  return {
      {"state", lines, everyone, &job.state_path,
       "a saved state, with lines drawn on the cloth as it hangs or lies; then without a garment"},
      {"gust", lines, everyone, &job.gust, not_negative,
       "and an acceleration to each of four sides for 0.4 s, and 2 s of calm [m/s^2]"},
      {"kept", lines, everyone, Share{[&job](double share) { job.kept = share; }},
       "share of its height with which a line holds (default 95%)"},
      {"whole", lines, everyone, &job.whole,
       "press what lies between the lines, too, where it could give way"},
      {"budget", lines, everyone, &job.budget, endless,
       "processor time after which the last rest state that was found is the end, which is no success [s]"},
      {"run", lines, few, &job.seconds, positive, "how long each trial runs forward from rest [s]"},
      {"no_balance", lines, few, off(job.balance),
       "do not turn a garment about its pins (at most 0.2 rad) until its centre of mass hangs below them"},
      {"no_settle", lines, few, off(job.settle),
       "on a body, keep the garment where it lies, though nothing holds it there; by default it comes to "
       "rest first"},
      {"no_help", lines, few, off(job.help),
       "no press, struts or lower height where the rest state alone does not hold"},
  };
}

}  // namespace furrow::jobs
