/// Number of a loop that ran for too long, 0 for none. Loops of a user's own snippets are counted, so that one without an end
/// cannot hold up the device; once one was found, all of them are left at once.
@group(0) @binding(auto) var<storage, read_write> overrun: atomic<u32>;

/// In place of the number of a loop: a ray was left before its end.
const CUT_RAY = 0xffffffffu;
const MOST_ROUNDS = 32768u;
const MOST_ROUNDS_A_RAY = 1048576u;
var<private> rounds_of_ray: u32;

/// Counts a round of loop `number`; whether the loop is to be left.
fn loop_is_over(rounds: ptr<function, u32>, number: u32) -> bool {
    if *rounds == 0u && atomicLoad(&overrun) != 0u {
        return true;
    }
    *rounds += 1u;
    rounds_of_ray += 1u;
    if *rounds <= MOST_ROUNDS && rounds_of_ray <= MOST_ROUNDS_A_RAY {
        return false;
    }
    atomicStore(&overrun, number);
    return true;
}
