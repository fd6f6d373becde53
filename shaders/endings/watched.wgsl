//! slot: endings
//! help: A ray that was left before its end, as some drivers do when all loops have taken too many rounds, is reported.

#include "traversal/bounds.wgsl"

fn ray_ended(walk: Walk) {
    if !walk.ended && atomicLoad(&overrun) == 0u {
        atomicStore(&overrun, CUT_RAY);
    }
}
