#include "search/linked/chain.h"

#include "search/linked/aboard.h"
#include "search/linked/turn.h"

namespace tandem {

namespace {

// Who comes behind a customer, or first on a route if `before` is a depot.
Int onward_of(const ProblemData& data, const Linked& linked, const Run& run, Int before) {
    return before < data.num_depots ? run.first : linked.link[before].behind;
}

// Lets one customer, or the depot, come right behind another, so far away.
[[gnu::always_inline]] inline void join(const ProblemData& data, Linked& linked, Run& run,
                                        Int before, Int behind, Int distance) {
    if (before >= data.num_depots) {
        Link& here = linked.link[before];
        here.behind = behind;
        here.onward = distance;
        linked.reach[before] = std::max(here.inward, distance);
    } else {
        run.first = behind;
    }
    if (behind >= data.num_depots) {
        Link& here = linked.link[behind];
        here.before = before;
        here.inward = distance;
        linked.reach[behind] = std::max(distance, here.onward);
    } else {
        run.last = before;
    }
}

void add_load(const ProblemData& data, Run& run, Int node) {
    write_amount(plus(amount_of(run.load), demand_of(data.place[0][node])), run.load);
}

void take_load(const ProblemData& data, Run& run, Int node) {
    write_amount(minus(amount_of(run.load), demand_of(data.place[0][node])), run.load);
}

// Lets what is aboard along a route be written anew before somebody asks.
void note_stale(Linked& linked, Int slot) {
    if (looks_aboard(linked)) linked.stale[slot] = true;
}

// Notes when a customer is left, and has to be reached, before that changes.
void note_times(Linked& linked, Int node) {
    NoteCounts& noted = linked.noted;
    if (noted.moments == linked.moment.size()) {
        noted.over = 1;
        return;
    }
    const Link& here = linked.link[node];
    linked.moment.at(noted.moments++) = {node, here.leave, here.latest};
}

// Takes the customer inserted last out again. Times stay as they are.
void untie(const ProblemData& data, Searcher& searcher, Linked& linked) {
    const Entry& entry = linked.entry[--linked.noted.entries];
    Link& here = linked.link[entry.node];
    const Int slot = here.slot;
    Run& run = linked.run[slot];
    join(data, linked, run, here.before, here.behind, entry.onward);
    if (here.behind >= data.num_depots) linked.link[here.behind].gap = entry.gap;
    note_stale(linked, slot);
    take_load(data, run, entry.node);
    here.slot = nowhere;
    linked.reach[entry.node] = out_of_reach;
    --run.count;
    run.distance -= here.inward + here.onward - entry.onward;
    if (run.count == 0) close_run(searcher, linked, slot);
}

// Puts the customers back that were taken out last. Times stay as they are.
void put_back(const ProblemData& data, Searcher& searcher, Linked& linked) {
    NoteCounts& noted = linked.noted;
    const Piece& piece = linked.piece[--noted.pieces];
    Run& run = linked.run[piece.slot];
    if (run.count == 0) open_run(data, searcher, linked, piece.slot, piece.type);
    note_stale(linked, piece.slot);
    const Int begin = noted.removed - piece.count;
    for (Int index = begin; index < noted.removed; ++index) {
        const Int node = linked.removed_node[index];
        const Link& here = linked.link[node] = linked.removed[index];
        linked.reach[node] = std::max(here.inward, here.onward);
        add_load(data, run, node);
    }
    const Int first = linked.removed_node[begin];
    const Int last = linked.removed_node[noted.removed - 1];
    const Int behind = linked.link[last].behind;
    join(data, linked, run, linked.link[first].before, first, linked.link[first].inward);
    join(data, linked, run, last, behind, linked.link[last].onward);
    if (behind >= data.num_depots) linked.link[behind].gap = piece.gap;
    run.count += piece.count;
    run.distance += piece.saved;
    noted.removed = begin;
}

// Lets customers, and times that were noted, be as they were when so much was noted.
void undo(const ProblemData& data, Searcher& searcher, Linked& linked, const NoteCounts& before) {
    NoteCounts& noted = linked.noted;
    while (noted.entries > before.entries) untie(data, searcher, linked);
    while (noted.pieces > before.pieces) put_back(data, searcher, linked);
    while (noted.moments > before.moments) {
        const Moment& moment = linked.moment[--noted.moments];
        linked.link[moment.node].leave = moment.leave;
        linked.link[moment.node].latest = moment.latest;
    }
}

}  // namespace

void open_run(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot, Int k) {
    Run& run = linked.run[slot];
    run = {k, data.type[k].ends_at, data.type[k].begins_at, 0, 0, {}};
    ++searcher.now.used[k];
    list_anew(searcher, slot, true);
}

void close_run(Searcher& searcher, Linked& linked, Int slot) {
    --searcher.now.used[linked.run[slot].type];
    list_anew(searcher, slot, false);
}

void tie_in(const ProblemData& data, Linked& linked, Int slot, Int before, Int node) {
    Run& run = linked.run[slot];
    const Int behind = onward_of(data, linked, run, before);
    const Int m = data.type[run.type].travel;
    const LegRow inward = legs_to(data.back, m, node);
    const LegRow onward = legs_from(data.leg, m, node);
    const Int there = distance_from(inward, before);
    const Int on = distance_to(onward, behind);
    Entry& entry = linked.entry.at(linked.noted.entries++);
    entry = {node, 0, 0};
    if (behind >= data.num_depots) {
        entry.onward = linked.link[behind].inward;
        entry.gap = linked.link[behind].gap;
    } else if (before >= data.num_depots) {
        entry.onward = linked.link[before].onward;
    }
    Link& here = linked.link[node];
    here.slot = slot;
    here.before = before;
    here.behind = behind;
    here.inward = there;
    here.onward = on;
    join(data, linked, run, before, node, there);
    join(data, linked, run, node, behind, on);
    if (linked.timed) {
        here.gap = leg_from(inward, before).duration;
        if (behind >= data.num_depots) linked.link[behind].gap = leg_to(onward, behind).duration;
    }
    note_stale(linked, slot);
    ++run.count;
    run.distance += there + on - entry.onward;
    add_load(data, run, node);
}

Int connect(const ProblemData& data, Linked& linked, Int slot, Int before, Int behind) {
    Run& run = linked.run[slot];
    note_stale(linked, slot);
    Int distance = 0;
    if (before >= data.num_depots || behind >= data.num_depots) {
        const LegRow onward = legs_from(data.leg, data.type[run.type].travel, before);
        distance = distance_to(onward, behind);
        if (linked.timed && behind >= data.num_depots) {
            linked.link[behind].gap = leg_to(onward, behind).duration;
        }
    }
    join(data, linked, run, before, behind, distance);
    return distance;
}

Int cut_out(const ProblemData& data, Linked& linked, Int slot, Int first, Int count) {
    NoteCounts& noted = linked.noted;
    Run& run = linked.run[slot];
    Piece& piece = linked.piece.at(noted.pieces++);
    piece = {slot, run.type, count, 0, 0};
    note_stale(linked, slot);
    const Int before = linked.link[first].before;
    Int saved = linked.link[first].inward;
    Int node = first;
    for (Int number = 0; number < count; ++number) {
        Link& here = linked.link[node];
        linked.removed.at(noted.removed) = here;
        linked.removed_node.at(noted.removed) = node;
        ++noted.removed;
        saved += here.onward;
        take_load(data, run, node);
        here.slot = nowhere;
        linked.reach[node] = out_of_reach;
        node = here.behind;
    }
    run.count -= count;
    Int distance = 0;
    if (run.count > 0) {
        const LegRow onward = legs_from(data.leg, data.type[run.type].travel, before);
        distance = distance_to(onward, node);
        if (linked.timed && node >= data.num_depots) {
            piece.gap = linked.link[node].gap;
            linked.link[node].gap = leg_to(onward, node).duration;
        }
    }
    join(data, linked, run, before, node, distance);
    piece.saved = saved - distance;
    run.distance -= piece.saved;
    return piece.saved;
}

void drive_on(const ProblemData& data, Linked& linked, Int slot, Int node, Int number) {
    if (node < data.num_depots) return;
    const VehicleType& type = data.type[linked.run[slot].type];
    const NodeTable places = data.place.by_truck(type);
    Front front = front_at(data, linked, type, linked.link[node].before);
    for (; node >= data.num_depots; --number) {
        Link& here = linked.link[node];
        front.serve(places[node], here.gap);
        if (here.leave == front.time && number <= 0) return;
        note_times(linked, node);
        here.leave = front.time;
        node = here.behind;
    }
}

void look_back(const ProblemData& data, Linked& linked, Int slot, Int node, Int number) {
    if (node < data.num_depots) return;
    const VehicleType& type = data.type[linked.run[slot].type];
    const NodeTable places = data.place.by_truck(type);
    const Int behind = linked.link[node].behind;
    Rear rear = rear_at(data, linked, type, behind);
    rear.drive(behind >= data.num_depots
                   ? linked.link[behind].gap
                   : leg(legs_of(data.leg, type.travel), node, behind).duration);
    for (; node >= data.num_depots; --number) {
        Link& here = linked.link[node];
        rear.serve(places[node]);
        if (here.latest == rear.latest && number <= 0) return;
        note_times(linked, node);
        here.latest = rear.latest;
        rear.drive(here.gap);
        node = here.before;
    }
}

void retime(const ProblemData& data, Linked& linked, Int slot) {
    const Run& run = linked.run[slot];
    drive_on(data, linked, slot, run.first, run.count);
    look_back(data, linked, slot, run.last, run.count);
}

void restore(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot,
             const NoteCounts& before) {
    undo(data, searcher, linked, before);
    if (linked.noted.over) retime(data, linked, slot);
}

void take_back(const ProblemData& data, Searcher& searcher, Linked& linked) {
    NoteCounts& noted = linked.noted;
    take_types_back(searcher, linked);
    undo(data, searcher, linked, {});
    if (noted.over) {
        for (const Int slot : searcher.active.first(searcher.count->active)) {
            retime(data, linked, slot);
        }
        noted.moments = noted.over = 0;
    }
}

void forget(Linked& linked) {
    for (const Int slot : linked.retyped.first(linked.noted.retyped)) linked.former[slot] = nowhere;
    linked.noted = {};
}

}  // namespace tandem
