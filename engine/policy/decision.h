// A decision of the policy `attention`, as its `step.onnx` computes it, without padding.
//
// A decision is so small that a call of a library for networks takes longer than its arithmetic,
// and a plan makes many of them.
#pragma once

#include <vector>

#include "policy/features.h"
#include "policy/lanes.h"

namespace tandem {

// Sizes of the network: loops of fixed length run twice as fast.
constexpr Int width = 96;
constexpr Int num_heads = 4;
constexpr Int head_width = width / num_heads;
constexpr Int action_width = 48;

// What the encoder made of a problem, (token, part after part): what queries read of the present
// place, keys, values, pointers, and a candidate's share of the network over actions.
using Embedding = View<const float, 2>;

// Decides between the candidates of one rollout after another.
class Decider {
public:
    // With room for so many candidates.
    Decider(const StepWeights& weights, Int most);

    // Write the scores of the candidates, (candidate,), before they are clipped.
    void score(Embedding memory, const Seen& seen, View<float, 1> scores);

private:
    void ask(Embedding memory, const Seen& seen);
    void describe_actions(Embedding memory, const Seen& seen);
    void weigh(Embedding memory, const Seen& seen);
    void normalise(Int count);
    void glimpse(Embedding memory, const Seen& seen);
    void point(Embedding memory, const Seen& seen, View<float, 1> scores);

    const StepWeights& weights_;
    alignas(64) float query_[width];
    std::vector<float> action_;  // (candidate, action_width), and room for some more
    std::vector<float> mixed_;   // (candidate, action_width)
    std::vector<float> weight_;  // (candidate, num_heads)
};

}  // namespace tandem
