#include "policy/rollouts.h"

#include <numeric>

#include "deadline.h"
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
    // An array whose rows are written before they are read.
    template <class T>
    class FreshRows {
    public:
        explicit FreshRows(Int size)
            : data_(std::make_unique_for_overwrite<T[]>(std::size_t(size))), size_(size) {}

        View<T, 1> view() { return {data_.get(), {size_}}; }

    private:
        std::unique_ptr<T[]> data_;
        Int size_;
    };

    Int count_ = 0;
    Int here_ = 0;
    FreshRows<Int> action_, token_;
    FreshRows<Outlook> outlook_;
    FreshRows<ActionFeatures> feature_;
    VehicleFeatures vehicle_;
};

// The most candidates that a decision may have.
Int most_candidates(const Instance& instance) {
    return 2 * instance.node.shape(2) + 1 + instance.type.shape(1);
}

// Plans a rollout.
class Planner {
public:
    Planner(const StepWeights& weights, const Scene& scene, State& state, Int scratch,
            const Deadline& deadline)
        : scene_(scene),
          state_(state),
          scratch_(scratch),
          deadline_(deadline),
          sight_(most_candidates(scene.instance)),
          decider_(weights, most_candidates(scene.instance)) {
        scores_.reserve(in_lanes(most_candidates(scene.instance)));
    }

    // Plan a rollout to its end and return how many actions it has.
    Int plan(const Course& course, Int r) {
        for (Int index = 0; index < course.kept; ++index) {
            apply(scene_.instance, state_, r, course.actions[index]);
        }
        const Seen seen = sight_.seen();
        for (Int index = course.kept; index < course.actions.size(); ++index) {
            if (deadline_.passed()) return given_up;
            observe(scene_, state_, r, scratch_, seen);
            if (seen.count == 0) return index;
            scores_.assign(in_lanes(seen.count), 0.0F);
            decider_.score(course.memory, seen, {scores_.data(), {seen.count}});
            const Int choice = choose(scores_, seen.count, course.temperature, course.random);
            const Int action = seen.action[choice];
            course.actions[index] = action;
            apply(scene_.instance, state_, r, action);
        }
        return course.actions.size();
    }

private:
    const Scene& scene_;
    State& state_;
    Int scratch_;
    Deadline deadline_;
    Sight sight_;
    Decider decider_;
    std::vector<float> scores_;
};

}  // namespace

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

Int roll_out(const StepWeights& weights, const Scene& scene, State& state, Int r,
             const Course& course, View<const Int, 1> alarm) {
    Planner planner(weights, scene, state, state.problem.size() - 1, Deadline(alarm));
    return planner.plan(course, r);
}

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
        const Instance& instance = scene->instance;
        const Scales& scale = scene->scale;
        *count = roll_out(
            *weights, {instance, scale, scene->type_token}, *state, r,
            {*memory, course->temperature, course->random, course->kept, course->actions}, *alarm);
    });
}
