//! The mean of some supports of a solid, by codes of the corners, ends or rims that they are on.

/// The codes of a solid's points whose mean is the nearest one, each once, and their weights.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mix {
    codes: [usize; 4],
    weights: [f64; 4],
    count: usize,
}

impl Mix {
    /// Adds a point's weight.
    pub fn add(&mut self, code: usize, weight: f64) {
        let known = self.codes[..self.count].iter().position(|&own| own == code);
        let k = known.unwrap_or(self.count);
        self.count = self.count.max(k + 1);
        self.codes[k] = code;
        self.weights[k] += weight;
    }
    /// Returns the codes.
    pub fn codes(&self) -> &[usize] {
        &self.codes[..self.count]
    }
    /// Returns the sum of the weights of codes for which something holds.
    pub fn sum(&self, holds: impl Fn(usize) -> bool) -> f64 {
        let all = self.codes().iter().zip(self.weights);
        all.filter(|(code, _)| holds(**code))
            .map(|both| both.1)
            .sum()
    }
    /// Returns the weight of a code.
    pub fn weight(&self, code: usize) -> f64 {
        self.sum(|own| own == code)
    }
}
