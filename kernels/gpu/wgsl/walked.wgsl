// Two lists of shapes, around any `body`. All threads read the same walked shape, where it lies: one access serves all,
// and no thread waits for others. The functions that name single numbers (`own_at`, `walked_at`, `body_at`) are generated.

fn walked_of(i: u32) -> Walked {
    return walked_at(params.loop_start + i);
}
