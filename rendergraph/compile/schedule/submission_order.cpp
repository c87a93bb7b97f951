// Vector clocks over the submissions: each submission raises the clocks of those that wait for it.
#include "rendergraph/compile/schedule/submission_order.h"

namespace lensgraph::rendergraph {

SubmissionOrder::SubmissionOrder(const Plan& plan, uint32_t queues, std::vector<uint8_t> endsWithHost,
                                 bool overlappingFrames)
    : plan_(plan),
      queues_(queues),
      endsWithHost_(std::move(endsWithHost)),
      thisFrame_(overlappingFrames ? static_cast<uint32_t>(plan.submissions.size()) : 0) {
  queueOf_.push_back(0);
  for (uint32_t first = 0; first <= thisFrame_; first += std::max(thisFrame_, 1u)) {
    for (const PlannedSubmission& submission : plan.submissions) queueOf_.push_back(submission.queue);
  }
  update();
}

void SubmissionOrder::update() {
  const auto count = static_cast<uint32_t>(plan_.submissions.size());
  waitsOf_.assign(queues_, {});
  for (uint32_t i = 0; i < count; ++i) {
    const PlannedSubmission& submission = plan_.submissions[i];
    for (uint32_t wait = submission.waits.first; wait < submission.waits.first + submission.waits.count; ++wait) {
      waitsOf_[submission.queue].push_back({wait, i});
    }
  }
  clocks_ = VectorClocks(queueOf_.size(), queues_);
  hostDone_.assign(count, kNone);
  const auto include = [&](Moment later, Moment earlier) { clocks_.include(later, clocks_.row(earlier)); };
  clocks_.of(0, 0) = 1;
  std::vector<Moment> last(queues_, kNone);
  last[0] = 0;
  Moment host = kNone;
  for (Moment moment = 1; moment < queueOf_.size(); ++moment) {
    const uint32_t i = (moment - 1) % count;
    const PlannedSubmission& submission = plan_.submissions[i];
    clocks_.of(moment, submission.queue) = moment + 1;
    if (last[submission.queue] != kNone) include(moment, last[submission.queue]);
    if (host != kNone) include(moment, host);
    for (const SubmissionWait& wait : plan_.waitsOf(submission)) {
      if (wait.stages != 0) include(moment, moment - i + wait.submission);
    }
    hostDone_[i] = host;
    last[submission.queue] = moment;
    if (endsWithHost_[i]) host = moment;
  }
}

}  // namespace lensgraph::rendergraph
