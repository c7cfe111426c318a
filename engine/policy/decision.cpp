#include "policy/decision.h"

#include <limits>

#include "guard.h"

namespace tandem {
namespace {

// Where the parts of a token's memory begin.
constexpr Int place_part = 0;
constexpr Int key_part = width;
constexpr Int value_part = 2 * width;
constexpr Int pointer_part = 3 * width;
constexpr Int share_part = 4 * width;

constexpr Int num_action_features = sizeof(ActionFeatures) / sizeof(float);
// Those behind are 0 where nobody states a rule that few state.
constexpr Int num_usual_features = offsetof(ActionFeatures, price) / sizeof(float);

constexpr Int blocks = width / num_lanes;                // of lanes, of a query
constexpr Int action_blocks = action_width / num_lanes;  // of what describes an action
constexpr Int head_blocks = head_width / num_half_lanes;

constexpr Int abreast =
    4;  // candidates that are multiplied together, so that a matrix is read once

static_assert(num_heads == 4 && abreast == 4, "four sums are taken together");

// 1 / sqrt(24) and 1 / sqrt(96)
constexpr float head_scale = 0.2041241452319315F;
constexpr float pointer_scale = 0.10206207261596575F;

Int whole_blocks(Int count, Int block) { return (count + block - 1) / block * block; }

// Add `x` times a matrix of so many blocks of columns to a row.
template <Int num_blocks>
void add_product(const float* x, View<const float, 2> matrix, float* result) {
    Lanes sum[num_blocks];
    for (Int k = 0; k < num_blocks; ++k) load(result + k * num_lanes, sum[k]);
    for (Int i = 0; i < matrix.size(); ++i) {
        const float* row = matrix[i].data();
        for (Int k = 0; k < num_blocks; ++k) {
            Lanes of_row;
            load(row + k * num_lanes, of_row);
            sum[k] += x[i] * of_row;
        }
    }
    for (Int k = 0; k < num_blocks; ++k) store(sum[k], result + k * num_lanes);
}

// Add rows, from an entry on, times a matrix to what describes actions.
//
// Sums have names, so that they stay in registers.
template <Int length, Int first = 0>
void add_products(const float* const (&rows)[abreast], const float* matrix,
                  Lanes (&sum)[abreast][action_blocks]) {
    for (Int k = 0; k < action_blocks; ++k) {
        Lanes a = sum[0][k], b = sum[1][k], c = sum[2][k], d = sum[3][k];
        for (Int i = first; i < length; ++i) {
            Lanes of_row;
            load(matrix + i * action_width + k * num_lanes, of_row);
            a += rows[0][i] * of_row;
            b += rows[1][i] * of_row;
            c += rows[2][i] * of_row;
            d += rows[3][i] * of_row;
        }
        sum[0][k] = a;
        sum[1][k] = b;
        sum[2][k] = c;
        sum[3][k] = d;
    }
}

// Whether any of some rows tells of a rule that few state.
bool tells_of_rarer(const float* const (&rows)[abreast]) {
    for (const float* row : rows) {
        for (Int i = num_usual_features; i < num_action_features; ++i) {
            if (row[i] != 0) return true;
        }
    }
    return false;
}

// Where what describes an action lies.
float* row_of(std::vector<float>& rows, Int index) { return rows.data() + index * action_width; }

void raise_to_zero(Lanes& x) { x = larger(x, Lanes{}); }

}  // namespace

Decider::Decider(const StepWeights& weights, Int most)
    : weights_(weights),
      query_{},
      action_(std::size_t(whole_blocks(most, abreast) * action_width)),
      mixed_(action_.size()),
      weight_(std::size_t(whole_blocks(most, abreast) * num_heads)) {}

// Ask from the present place and the state of the vehicle.
void Decider::ask(Embedding memory, const Seen& seen) {
    alignas(64) float hidden[width];
    const float* place = memory[seen.here].data() + place_part;
    const float* glob = reinterpret_cast<const float*>(&seen.vehicle);
    std::copy_n(weights_.globe_bias.data(), width, hidden);
    add_product<blocks>(glob, weights_.globe, hidden);
    for (Int k = 0; k < blocks; ++k) {
        Lanes x;
        load(hidden + k * num_lanes, x);
        Lanes fallen = Lanes{} - x;
        exponentiate(fallen);
        store(x / (Lanes::all(1.0F) + fallen), hidden + k * num_lanes);
    }
    for (Int j = 0; j < width; ++j) query_[j] = weights_.globe_output_bias[j] + place[j];
    add_product<blocks>(hidden, weights_.globe_output, query_);
}

// Run the network over actions but for what is asked of them and for its score.
void Decider::describe_actions(Embedding memory, const Seen& seen) {
    const float* bias = weights_.action_bias.data();
    for (Int first = 0; first < seen.count; first += abreast) {
        const float* feature[abreast];
        const float* action[abreast];
        Lanes sum[abreast][action_blocks];
        for (Int row = 0; row < abreast; ++row) {
            // Behind the last candidate, it is done again, and nobody reads of it.
            const Int index = std::min(first + row, seen.count - 1);
            feature[row] = reinterpret_cast<const float*>(&seen.feature[index]);
            action[row] = row_of(action_, first + row);
            const float* share = memory[seen.token[index]].data() + share_part;
            for (Int k = 0; k < action_blocks; ++k) {
                Lanes usual, own;
                load(bias + k * num_lanes, usual);
                load(share + k * num_lanes, own);
                sum[row][k] = usual + own;
            }
        }
        add_products<num_usual_features>(feature, weights_.action.data(), sum);
        if (tells_of_rarer(feature)) {
            add_products<num_action_features, num_usual_features>(feature, weights_.action.data(),
                                                                  sum);
        }
        for (Int row = 0; row < abreast; ++row) {
            for (Int k = 0; k < action_blocks; ++k) {
                raise_to_zero(sum[row][k]);
                store(sum[row][k], row_of(action_, first + row) + k * num_lanes);
                sum[row][k] = Lanes{};
            }
        }
        add_products<action_width>(action, weights_.action_mix.data(), sum);
        for (Int row = 0; row < abreast; ++row) {
            for (Int k = 0; k < action_blocks; ++k) {
                store(sum[row][k], row_of(mixed_, first + row) + k * num_lanes);
            }
        }
    }
}

// Find how much each head looks at each candidate, before the softmax.
void Decider::weigh(Embedding memory, const Seen& seen) {
    HalfLanes query[num_heads][head_blocks];
    Lanes bias[num_heads][action_blocks];
    for (Int head = 0; head < num_heads; ++head) {
        for (Int k = 0; k < head_blocks; ++k) {
            load(query_ + head * head_width + k * num_half_lanes, query[head][k]);
        }
        for (Int k = 0; k < action_blocks; ++k) {
            load(weights_.glimpse_bias[head].data() + k * num_lanes, bias[head][k]);
        }
    }
    for (Int index = 0; index < seen.count; ++index) {
        const float* key = memory[seen.token[index]].data() + key_part;
        const float* action = action_.data() + index * action_width;
        HalfLanes alike[num_heads];
        Lanes of_action[num_heads];
        for (Int head = 0; head < num_heads; ++head) {
            alike[head] = HalfLanes{};
            of_action[head] = Lanes{};
            for (Int k = 0; k < head_blocks; ++k) {
                HalfLanes own;
                load(key + head * head_width + k * num_half_lanes, own);
                alike[head] += query[head][k] * own;
            }
            for (Int k = 0; k < action_blocks; ++k) {
                Lanes own;
                load(action + k * num_lanes, own);
                of_action[head] += bias[head][k] * own;
            }
        }
        store(sums_of(of_action) + sums_of(alike) * head_scale, weight_.data() + index * num_heads);
    }
}

// Replace each head's weights by their softmax.
void Decider::normalise(Int count) {
    const Int behind = whole_blocks(count, abreast);
    float* weight = weight_.data();
    std::fill(weight + count * num_heads, weight + behind * num_heads,
              -std::numeric_limits<float>::infinity());
    Lanes top;
    load(weight, top);
    for (Int i = num_lanes; i < behind * num_heads; i += num_lanes) {
        Lanes some;
        load(weight + i, some);
        top = larger(some, top);
    }
    // Lanes hold four candidates, each by its heads.
    float most[num_lanes];
    store(top, most);
    for (Int lane = num_heads; lane < num_lanes; ++lane) {
        most[lane % num_heads] = std::max(most[lane % num_heads], most[lane]);
    }
    for (Int lane = num_heads; lane < num_lanes; ++lane) most[lane] = most[lane % num_heads];
    load(most, top);
    Lanes total{};
    for (Int i = 0; i < behind * num_heads; i += num_lanes) {
        Lanes some;
        load(weight + i, some);
        some = some - top;
        exponentiate(some);
        store(some, weight + i);
        total += some;
    }
    const Quad sum = folded(total);
    float sums[num_lanes];
    for (Int lane = 0; lane < num_lanes; ++lane) sums[lane] = sum[lane % num_heads];
    load(sums, total);
    for (Int i = 0; i < behind * num_heads; i += num_lanes) {
        Lanes some;
        load(weight + i, some);
        store(some / total, weight + i);
    }
}

// Ask again, by the candidates' values mixed by weight.
void Decider::glimpse(Embedding memory, const Seen& seen) {
    HalfLanes sum[num_heads][head_blocks]{};
    for (Int index = 0; index < seen.count; ++index) {
        const float* value = memory[seen.token[index]].data() + value_part;
        const float* weight = weight_.data() + index * num_heads;
        for (Int head = 0; head < num_heads; ++head) {
            for (Int k = 0; k < head_blocks; ++k) {
                HalfLanes own;
                load(value + head * head_width + k * num_half_lanes, own);
                sum[head][k] += weight[head] * own;
            }
        }
    }
    alignas(64) float glimpsed[width];
    for (Int head = 0; head < num_heads; ++head) {
        for (Int k = 0; k < head_blocks; ++k) {
            store(sum[head][k], glimpsed + head * head_width + k * num_half_lanes);
        }
    }
    add_product<blocks>(glimpsed, weights_.glimpse_output, query_);
}

// Write the scores, four at a time.
void Decider::point(Embedding memory, const Seen& seen, View<float, 1> scores) {
    alignas(64) float asked[action_width];
    std::copy_n(weights_.action_mix_bias.data(), action_width, asked);
    add_product<action_blocks>(query_, weights_.action_query, asked);
    Lanes query[blocks], ask[action_blocks], factor[action_blocks];
    for (Int k = 0; k < blocks; ++k) load(query_ + k * num_lanes, query[k]);
    for (Int k = 0; k < action_blocks; ++k) {
        load(asked + k * num_lanes, ask[k]);
        load(weights_.action_score.data() + k * num_lanes, factor[k]);
    }
    for (Int first = 0; first < seen.count; first += abreast) {
        Lanes dot[abreast], extra[abreast];
        for (Int row = 0; row < abreast; ++row) {
            const Int index = std::min(first + row, seen.count - 1);
            const float* pointer = memory[seen.token[index]].data() + pointer_part;
            const float* mixed = mixed_.data() + index * action_width;
            dot[row] = Lanes{};
            extra[row] = Lanes{};
            for (Int k = 0; k < blocks; ++k) {
                Lanes own;
                load(pointer + k * num_lanes, own);
                dot[row] += query[k] * own;
            }
            for (Int k = 0; k < action_blocks; ++k) {
                Lanes own;
                load(mixed + k * num_lanes, own);
                own += ask[k];
                raise_to_zero(own);
                extra[row] += factor[k] * own;
            }
        }
        const Quad four = sums_of(dot) * pointer_scale + sums_of(extra);
        for (Int row = 0; row < std::min(abreast, seen.count - first); ++row) {
            scores[first + row] = four[row];
        }
    }
}

TANDEM_FOR_PROCESSORS
void Decider::score(Embedding memory, const Seen& seen, View<float, 1> scores) {
    ask(memory, seen);
    describe_actions(memory, seen);
    weigh(memory, seen);
    normalise(seen.count);
    glimpse(memory, seen);
    point(memory, seen, scores);
}

}  // namespace tandem

using namespace tandem;

int tandem_candidate_scores(const tandem_step_weights* weights, const tandem_f32_2d* memory,
                            const tandem_observation* seen, int64_t r,
                            const tandem_f32_1d* scores) {
    return guarded([&] {
        const StepWeights& of_step = *weights;
        const Observation& observation = *seen;
        Decider decider(of_step, observation.token.shape(1));
        decider.score(*memory, seen_of(observation, r), *scores);
    });
}
