// Rollouts of the policy `attention`, from the first actions to the end of a plan.
#include <numeric>

#include "deadline.h"
#include "policy/decision.h"
#include "randomness.h"
#include "simulation/simulator.h"

namespace tandem {
namespace {

constexpr float clip = 10;  // what the scores are clipped to, softly

constexpr Int given_up = -1;  // number of actions of a rollout that was not ended

// The least number of whole lanes' floats that so many fit in.
std::size_t in_lanes(Int count) {
    return std::size_t((count + num_lanes - 1) / num_lanes * num_lanes);
}

// Replace scores by weights in proportion to probabilities, that of the best being 1.
void weigh(std::vector<float>& scores, Int best, float temperature) {
    const float scale = clip / temperature;
    for (std::size_t i = 0; i < scores.size(); i += num_lanes) {
        Lanes x;
        load(&scores[i], x);
        // clip * tanh(2 * x / clip)
        Lanes power = (-4 / clip) * x;
        exponentiate(power);
        const Lanes one = Lanes::all(1.0F);
        store(scale * ((one - power) / (one + power)), &scores[i]);
    }
    const float top = scores[std::size_t(best)];
    for (std::size_t i = 0; i < scores.size(); i += num_lanes) {
        Lanes x;
        load(&scores[i], x);
        x = x - Lanes::all(top);
        exponentiate(x);
        store(x, &scores[i]);
    }
}

// Room for what one decision sees.
class Sight {
public:
    explicit Sight(Int most)
        : action_(most), token_(most), outlook_(most), feature_(most), vehicle_{} {}

    Seen seen() {
        return {count_,          action_.view(), token_.view(), outlook_.view(),
                feature_.view(), vehicle_,       here_};
    }

private:
    Int count_ = 0, here_ = 0;
    Row<Int> action_, token_;
    Row<Outlook> outlook_;
    Row<ActionFeatures> feature_;
    VehicleFeatures vehicle_;
};

// The most candidates that a decision may have.
Int most_candidates(const Instance& instance) {
    return 2 * instance.problem[0].node.shape(1) + 1 + instance.problem[0].type.size();
}

// The likeliest of so many candidates, or one drawn by probability if the temperature isn't 0.
//
// Scores fill whole lanes. If one is drawn, they are overwritten, and the state of random numbers
// moves on.
Int choose(std::vector<float>& scores, Int count, double temperature,
           View<std::uint64_t, 1> random) {
    const auto end = scores.begin() + count;
    const Int best = std::max_element(scores.begin(), end) - scores.begin();
    if (temperature <= 0) return best;
    weigh(scores, best, float(temperature));
    double left = uniform(random) * std::accumulate(scores.begin(), end, 0.0);
    for (Int index = 0; index < count; ++index) {
        left -= scores[std::size_t(index)];
        if (left < 0) return index;
    }
    return best;
}

// Plans a rollout.
class Planner {
public:
    // By what the encoder made of the scene, until a deadline.
    Planner(const StepWeights& weights, Embedding memory, const Scene& scene, State& state,
            const Deadline& deadline)
        : memory_(memory),
          scene_(scene),
          state_(state),
          scratch_(state.problem.size() - 1),
          deadline_(deadline),
          sight_(most_candidates(scene.instance)),
          decider_(weights, most_candidates(scene.instance)) {
        scores_.reserve(in_lanes(most_candidates(scene.instance)));
    }

    // Plan a rollout to its end and return how many actions it has.
    Int plan(const tandem_course& course, Int r) {
        for (Int index = 0; index < course.kept; ++index) {
            apply(scene_.instance, state_, r, course.actions[index]);
        }
        const Seen seen = sight_.seen();
        for (Int index = course.kept; index < course.actions.size(); ++index) {
            if (deadline_.passed()) return given_up;
            observe(scene_, state_, r, scratch_, seen);
            if (seen.count == 0) return index;
            scores_.assign(in_lanes(seen.count), 0.0F);
            decider_.score(memory_, seen, {scores_.data(), {seen.count}});
            const Int choice = choose(scores_, seen.count, course.temperature, course.random);
            const Int action = seen.action[choice];
            course.actions[index] = action;
            apply(scene_.instance, state_, r, action);
        }
        return course.actions.size();
    }

private:
    const Embedding memory_;
    const Scene& scene_;
    State& state_;
    Int scratch_;
    Deadline deadline_;
    Sight sight_;
    Decider decider_;
    std::vector<float> scores_;
};

}  // namespace

}  // namespace tandem

using namespace tandem;

int tandem_choose(const tandem_f32_1d* scores, double temperature, const tandem_u64_1d* random,
                  int64_t* choice) {
    return guarded([&] {
        const Int count = scores->size();
        std::vector<float> padded(scores->begin(), scores->end());
        padded.resize(in_lanes(count));
        *choice = choose(padded, count, temperature, *random);
    });
}

int tandem_roll_out(const tandem_step_weights* weights, const tandem_f32_2d* memory,
                    const tandem_scene* scene, tandem_state* state, int64_t r,
                    const tandem_course* course, const tandem_i64_1d* alarm, int64_t* count) {
    return guarded([&] {
        *count = Planner(*weights, *memory, *scene, *state, Deadline(*alarm)).plan(*course, r);
    });
}
