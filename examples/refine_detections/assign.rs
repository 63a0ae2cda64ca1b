//! One-to-one assignment with the largest sum of gains.

/// The one-to-one pairs of rows and columns with the largest sum of gains, by row.
///
/// Shortest augmenting paths with potentials, one row at a time (Jonker and Volgenant 1987), in
/// O(rows² · columns).
pub fn assign(gains: &[f32], rows: usize, columns: usize) -> Vec<(usize, usize)> {
    if rows > columns {
        let turned: Vec<f32> = (0..rows * columns)
            .map(|i| gains[i % rows * columns + i / rows])
            .collect();
        let mut pairs: Vec<_> = assign(&turned, columns, rows)
            .into_iter()
            .map(|(column, row)| (row, column))
            .collect();
        pairs.sort_unstable();
        return pairs;
    }
    let cost = |row: usize, column: usize| -f64::from(gains[row * columns + column]);
    // Column `columns` stands for "none yet": a new row starts from there.
    let (mut row_price, mut column_price) = (vec![0.0; rows], vec![0.0; columns + 1]);
    let mut row_of = vec![None; columns + 1];
    for new in 0..rows {
        row_of[columns] = Some(new);
        let mut least = vec![(f64::INFINITY, columns); columns];
        let mut done = vec![false; columns + 1];
        let mut column = columns;
        while let Some(row) = row_of[column] {
            done[column] = true;
            let mut next = (f64::INFINITY, columns);
            for other in (0..columns).filter(|&other| !done[other]) {
                let slack = cost(row, other) - row_price[row] - column_price[other];
                if slack < least[other].0 {
                    least[other] = (slack, column);
                }
                if least[other].0 < next.0 {
                    next = (least[other].0, other);
                }
            }
            for seen in 0..=columns {
                if done[seen] {
                    column_price[seen] -= next.0;
                    row_price[row_of[seen].expect("a visited column has a row")] += next.0;
                } else {
                    least[seen].0 -= next.0;
                }
            }
            column = next.1;
        }
        // Back along the path, every row moves to the column after its own.
        while column != columns {
            let before = least[column].1;
            row_of[column] = row_of[before];
            column = before;
        }
    }
    let mut pairs: Vec<_> = (0..columns)
        .filter_map(|column| row_of[column].map(|row| (row, column)))
        .collect();
    pairs.sort_unstable();
    pairs
}
