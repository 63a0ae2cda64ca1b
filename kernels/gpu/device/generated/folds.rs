//! Folds over paths: one thread per path walks along its edges.
use super::operation::{ProgramName, ShaderBody, body_of, part};
use super::text::{GROUP, KernelForm, MOST_GROUPS, call};
use crate::ad::program::WGSL;
use crate::ad::program::recorded::Recorded;
use crate::kernels::call::folding::{FoldPrograms, Folding, Sizes};
use crate::kernels::cpu::checked::check_upstream;
use crate::kernels::cpu::folds::check;
use crate::kernels::cpu::folds::paths::paths;
use crate::kernels::cpu::program::split::Subgraph;
use crate::kernels::gpu::device::context::Device;
use crate::kernels::gpu::device::work::Commands;
use crate::kernels::machine::{Input, PathSpans, VertexBars};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::rows::numbers;
use crate::kernels::row::once::Key;
use crate::{Error, Vec2};
use std::borrow::Cow;
use std::fmt::Write;
use std::ops::Range;
use std::sync::Arc;

/// The shaders of a fold: written once, compiled once per device.
#[derive(Debug)]
pub(super) struct GeneratedFold {
    name: ProgramName,
    edge: ShaderBody,
    join: ShaderBody,
    finish: ShaderBody,
    /// The pull-back of each, without its result.
    edge_vjp: ShaderBody,
    join_vjp: ShaderBody,
    finish_vjp: ShaderBody,
    /// The state before the first edge.
    empty: Vec<f32>,
    is_closed: bool,
    /// The number of scalars of a vertex.
    element: usize,
    /// The number of scalars of a context.
    context: usize,
    /// The number of scalars of a context with its reference vertex.
    shared: usize,
    /// The number of scalars of a result.
    out: usize,
}

/// Writes the shaders of a fold, whose state before the first edge is `empty`.
pub(super) fn shaders(
    programs: &FoldPrograms,
    sizes: &Sizes,
    empty: Vec<f32>,
) -> Result<Arc<GeneratedFold>, Error> {
    programs.made.made(Key::Gpu(Mode::Value, false), &|| {
        let piece = |recorded: &Recorded| Subgraph {
            graph: recorded.value.graph.clone(),
            outputs: recorded.value.outputs.clone(),
        };
        let whole =
            |name, recorded: &Recorded| body_of(name, &piece(recorded), recorded.inputs, &[]);
        let edge_vjp = piece(&programs.edge_vjp);
        let derivatives = part(&edge_vjp, &edge_vjp.outputs[sizes.state..]);
        Ok(GeneratedFold {
            name: ProgramName::default(),
            edge: whole("fold_edge", &programs.edge),
            join: whole("fold_join", &programs.join),
            finish: whole("fold_finish", &programs.finish),
            edge_vjp: body_of("fold_edge_vjp", &derivatives, programs.edge_vjp.inputs, &[]),
            join_vjp: whole("fold_join_vjp", &programs.join_vjp),
            finish_vjp: whole("fold_finish_vjp", &programs.finish_vjp),
            empty: empty.clone(),
            is_closed: sizes.closed,
            element: sizes.element,
            context: sizes.own,
            shared: sizes.wide,
            out: sizes.out,
        })
    })
}

/// Returns the shaders of the fold of a call.
fn shaders_of(folding: &Folding<f32>) -> Result<Arc<GeneratedFold>, Error> {
    let mut empty = vec![0.0; folding.sizes.state];
    (folding.joined)(&[], &mut empty);
    shaders(&*(folding.programs)()?, &folding.sizes, empty)
}

/// Returns `count` names: `name0`, `name1`, …
fn names(name: &str, count: usize) -> Vec<String> {
    (0..count).map(|k| format!("{name}{k}")).collect()
}

/// Returns some elements of an array.
fn elements(array: &str, range: Range<usize>) -> Vec<String> {
    range.map(|k| format!("{array}[{k}]")).collect()
}

impl GeneratedFold {
    fn state(&self) -> usize {
        self.empty.len()
    }
    /// Returns the shader of a kernel.
    pub fn text(&self, form: KernelForm) -> String {
        let mut text = format!("{WGSL}\n{}\n{}\n", self.edge.text, self.join.text);
        match form {
            KernelForm::FoldDerivatives => {
                for body in [&self.edge_vjp, &self.join_vjp, &self.finish_vjp] {
                    text += &body.text;
                }
                text += &self.derivatives();
            }
            _ => {
                text += &self.finish.text;
                text += &self.values();
            }
        }
        text
    }
    /// Returns the bindings and the start of a thread's work: the numbers of its path, and the range of its edges.
    fn head(&self, entry: &str, more: &[(&str, &str)]) -> String {
        let vertex = match self.element {
            2 => "vec2f".to_owned(),
            n => format!("array<f32, {n}>"),
        };
        let mut text = format!(
            "@group(0) @binding(0) var<uniform> params: array<vec4u, 1>;
@group(0) @binding(1) var<storage, read> offsets: array<u32>;
@group(0) @binding(2) var<storage, read> vertices: array<{vertex}>;
@group(0) @binding(3) var<storage, read> shared_numbers: array<f32>;
",
        );
        for (k, (access, name)) in more.iter().enumerate() {
            let _ = writeln!(
                text,
                "@group(0) @binding({}) var<storage, {access}> {name}: array<f32>;",
                k + 4
            );
        }
        // The layout of bindings follows from their use, so `shared_numbers` is used even if a fold has no context.
        let _ = write!(
            text,
            "
@compute @workgroup_size({GROUP})
fn {entry}(@builtin(global_invocation_id) thread: vec3u) {{
    let path = thread.x;
    if path >= params[0].x {{
        return;
    }}
    let start = offsets[path];
    let count = offsets[path + 1u] - start;
    let edges = {};
    _ = shared_numbers[0];
",
            if self.is_closed {
                "count"
            } else {
                "max(count, 1u) - 1u"
            }
        );
        for k in 0..self.shared {
            let _ = writeln!(
                text,
                "    let s{k} = shared_numbers[path * {}u + {k}u];",
                self.shared
            );
        }
        for (k, x) in self.empty.iter().enumerate() {
            // As bits, since WGSL has no literal for infinity or NaN.
            let _ = writeln!(text, "    var state{k} = bitcast<f32>({}u);", x.to_bits());
        }
        text
    }
    /// Returns the WGSL that computes the state of one edge as `edge`, and the numbers that it takes.
    fn edge_of(&self) -> (String, Vec<String>) {
        let mut inputs = names("s", self.shared);
        for end in ["tail", "tip"] {
            match self.element {
                2 => inputs.extend(["x", "y"].map(|axis| format!("{end}.{axis}"))),
                n => inputs.extend(elements(end, 0..n)),
            }
        }
        let text = format!(
            "        let next = select(k + 1u, 0u, k + 1u == count);
        let tail = vertices[start + k];
        let tip = vertices[start + next];
        let edge = {};
",
            call("fold_edge", inputs.clone())
        );
        (text, inputs)
    }
    /// Returns the WGSL that joins the state of an edge to that of the edges before.
    fn join_of(&self) -> String {
        let mut inputs = names("state", self.state());
        inputs.extend(elements("edge", 0..self.state()));
        let mut text = format!("        let joined = {};\n", call("fold_join", inputs));
        for k in 0..self.state() {
            let _ = writeln!(text, "        state{k} = joined[{k}];");
        }
        text
    }
    /// Returns the kernel of values.
    fn values(&self) -> String {
        let mut text = self.head("fold_main", &[("read_write", "outputs")]);
        let mut inputs = names("s", self.shared);
        inputs.extend(names("state", self.state()));
        let _ = write!(
            text,
            "    for (var k = 0u; k < edges; k++) {{\n{}{}    }}\n    let y = {};\n",
            self.edge_of().0,
            self.join_of(),
            call("fold_finish", inputs)
        );
        for k in 0..self.out {
            let _ = writeln!(text, "    outputs[path * {}u + {k}u] = y[{k}];", self.out);
        }
        text + "}\n"
    }
    /// Returns the kernel of derivatives: joins the edges, keeping the state before each, then pulls the cotangent back
    /// from the last edge to the first.
    fn derivatives(&self) -> String {
        let (state, context, shared, n) = (self.state(), self.context, self.shared, self.element);
        let buffers = [
            ("read", "upstream"),
            ("read_write", "before"),
            ("read_write", "context_bars"),
            ("read_write", "path_bars"),
        ];
        let mut text = self.head("fold_slopes_main", &buffers);
        let lines =
            |count: usize, line: &dyn Fn(usize) -> String| (0..count).map(line).collect::<String>();
        let keep = lines(state, &|k| {
            format!("        before[(start + k) * {state}u + {k}u] = state{k};\n")
        });
        let recall = lines(state, &|k| {
            format!("        state{k} = before[(start + k) * {state}u + {k}u];\n")
        });
        let (edge, edge_inputs) = self.edge_of();
        let join = self.join_of();
        let mut end = names("s", shared);
        end.extend(names("state", state));
        end.extend((0..self.out).map(|k| format!("upstream[path * {}u + {k}u]", self.out)));
        let end = call("fold_finish_vjp", end);
        let contexts = lines(context, &|k| format!("    var context{k} = ended[{k}];\n"));
        let bars = lines(state, &|k| {
            format!("    var bar{k} = ended[{}];\n", shared + k)
        });
        let mut pulled = names("state", state);
        pulled.extend(elements("edge", 0..state));
        pulled.extend(names("bar", state));
        let pulled = call("fold_join_vjp", pulled);
        let hand_on = lines(state, &|k| format!("        bar{k} = pulled[{k}];\n"));
        let mut derivatives = edge_inputs;
        derivatives.extend(elements("pulled", state..2 * state));
        let derivatives = call("fold_edge_vjp", derivatives);
        let add = lines(context, &|k| {
            format!("        context{k} += slopes[{k}];\n")
        });
        let add_ends = lines(2 * n, &|k| {
            let (end, axis) = (if k < n { "k" } else { "next" }, k % n);
            format!(
                "        path_bars[{n}u * (start + {end}) + {axis}u] += slopes[{}];\n",
                shared + k
            )
        });
        // Adding zero removes the sign of zeros.
        let put = lines(context, &|k| {
            format!("    context_bars[path * {context}u + {k}u] = context{k} + 0.0;\n")
        });
        // An empty array cannot be bound: the buffer has one unused number per path.
        let unused = match context {
            0 => "    context_bars[path] = 0.0;\n",
            _ => "",
        };
        let _ = write!(
            text,
            "    for (var k = 0u; k < edges; k++) {{
{keep}{edge}{join}    }}
    let ended = {end};
{contexts}{bars}    for (var i = edges; i > 0u; i--) {{
        let k = i - 1u;
{recall}{edge}        let pulled = {pulled};
{hand_on}        let slopes = {derivatives};
{add}{add_ends}    }}
{put}{unused}}}
"
        );
        text
    }
}

/// Paths that are uploaded together.
struct PathLoad {
    paths: Range<usize>,
    vertices: Range<usize>,
}

/// The offsets and vertices of paths. A path that all contexts share is repeated on a GPU.
struct PathList<'a> {
    offsets: Cow<'a, [usize]>,
    numbers: &'a [f32],
    /// The number of vertices of a shared path.
    shared: Option<usize>,
}

impl<'a> PathList<'a> {
    fn new(input: &'a Input<'_, f32>) -> Result<Self, Error> {
        let (offsets, shared) = match input.spans {
            PathSpans::Ragged(offsets) => (offsets.into(), None),
            PathSpans::Shared(paths, length) => {
                paths.checked_mul(length).ok_or(Error::TooLarge)?;
                let offsets = (0..=paths).map(|k| k * length);
                (offsets.collect(), Some(length))
            }
        };
        Ok(PathList {
            offsets,
            numbers: &input.vertices,
            shared,
        })
    }
    /// Returns the numbers of some vertices, `element` each.
    fn vertices(&self, vertices: &Range<usize>, element: usize) -> Cow<'a, [f32]> {
        match self.shared {
            Some(0) => Cow::Borrowed(&[]),
            Some(length) => self.numbers.repeat(vertices.len() / length).into(),
            None => self.numbers[vertices.start * element..vertices.end * element].into(),
        }
    }
}

/// Checks paths. Returns the context and then the reference vertex of every path, as numbers.
fn shared(folding: &Folding<f32>, input: &Input<'_, f32>) -> Result<Vec<f32>, Error> {
    check(folding, input)?;
    Ok(paths(folding, input)?.shared)
}

impl Device {
    /// Writes the result of every path.
    pub(crate) fn folded(
        &self,
        folding: &Folding<f32>,
        input: &Input<'_, f32>,
        out: &mut [f32],
    ) -> Result<(), Error> {
        if let Some(measure) = folding.measure {
            let ends = [0, input.plane.len()];
            let rings = self.upload_rings(input.plane, input.spans.offsets(&ends))?;
            // A measure has one number, or the two of a point.
            return match measure.fields() {
                1 => {
                    let found = self.ragged_of::<f32>(measure, &rings)?;
                    out.copy_from_slice(&found.start_download()?.wait()?);
                    Ok(())
                }
                _ => {
                    let found = self.ragged_of::<Vec2<f32>>(measure, &rings)?;
                    out.copy_from_slice(&numbers(&found.start_download()?.wait()?));
                    Ok(())
                }
            };
        }
        let shaders = shaders_of(folding)?;
        let shared = shared(folding, input)?;
        let listed = PathList::new(input)?;
        let inner = &self.inner;
        inner.alive()?;
        for load in self.loads(&shaders, &listed.offsets, shaders.element)? {
            let count = load.paths.len();
            let results = inner.guarded(|| {
                let pipeline = inner.generated(&shaders.name, KernelForm::Fold, || {
                    shaders.text(KernelForm::Fold)
                });
                let own = self.upload(&shaders, &load, &listed, &shared);
                let results = inner.storage(count * shaders.out);
                let mut work = Commands::new(inner);
                let [a, b, c] = own.each_ref();
                let buffers = [(1, a), (2, b), (3, c), (4, &results)];
                let params = [[count as u32, 0, 0, 0]];
                work.dispatch_with(&pipeline, &params, &buffers, groups(count));
                work.submit()?;
                Ok(results)
            })?;
            let bytes = 4 * (count * shaders.out) as u64;
            let own = &mut out[load.paths.start * shaders.out..load.paths.end * shaders.out];
            inner
                .bring(self, &[(&results, bytes)])?
                .finish(|_, numbers| own.copy_from_slice(bytemuck::cast_slice(numbers)))?;
        }
        Ok(())
    }

    /// Writes the cotangents of contexts and vertices. Cotangents of a shared path are added to `vertex_bars`, which
    /// must be zero.
    pub(crate) fn folded_back(
        &self,
        folding: &Folding<f32>,
        input: &Input<'_, f32>,
        upstream: &[f32],
        context_bars: &mut [f32],
        vertex_bars: VertexBars<'_, f32>,
    ) -> Result<(), Error> {
        let path_bars = match vertex_bars {
            VertexBars::Plane(measure, bars) => {
                let ends = [0, input.plane.len()];
                let rings = self.upload_rings(input.plane, input.spans.offsets(&ends))?;
                let found = self.ragged_vjp_of(measure, &rings, (input.spans.count(), upstream))?;
                bars.copy_from_slice(&found.start_download()?.wait()?);
                return Ok(());
            }
            VertexBars::Numbers(bars) => bars,
        };
        let shaders = shaders_of(folding)?;
        let shared = shared(folding, input)?;
        check_upstream(upstream, shaders.out.max(1))?;
        let listed = PathList::new(input)?;
        let inner = &self.inner;
        inner.alive()?;
        for load in self.loads(
            &shaders,
            &listed.offsets,
            shaders.state().max(shaders.element),
        )? {
            let (count, vertices) = (load.paths.len(), load.vertices.len());
            let form = KernelForm::FoldDerivatives;
            let (by_context, by_vertex) = inner.guarded(|| {
                let pipeline = inner.generated(&shaders.name, form, || shaders.text(form));
                let own = self.upload(&shaders, &load, &listed, &shared);
                let seeds = &upstream[load.paths.start * shaders.out..load.paths.end * shaders.out];
                let seeds = inner.stored(seeds);
                let before = inner.storage(vertices * shaders.state());
                let by_context = inner.storage(count * shaders.context.max(1));
                let by_vertex = inner.storage(shaders.element * vertices);
                let mut work = Commands::new(inner);
                let [a, b, c] = own.each_ref();
                let buffers = [
                    (1, a),
                    (2, b),
                    (3, c),
                    (4, &seeds),
                    (5, &before),
                    (6, &by_context),
                    (7, &by_vertex),
                ];
                let params = [[count as u32, 0, 0, 0]];
                work.dispatch_with(&pipeline, &params, &buffers, groups(count));
                work.submit()?;
                Ok((by_context, by_vertex))
            })?;
            let parts = [
                (&by_context, 4 * (count * shaders.context.max(1)) as u64),
                (&by_vertex, 4 * (shaders.element * vertices) as u64),
            ];
            let of_contexts = &mut context_bars
                [load.paths.start * shaders.context..load.paths.end * shaders.context];
            inner.bring(self, &parts)?.finish(|part, numbers| {
                let numbers: &[f32] = bytemuck::cast_slice(numbers);
                match (part, listed.shared) {
                    (0, _) => {
                        let all = of_contexts.len();
                        of_contexts.copy_from_slice(&numbers[..all]);
                    }
                    (_, Some(length)) => {
                        for bars in numbers.chunks_exact((shaders.element * length).max(1)) {
                            let sums = path_bars.iter_mut().zip(bars);
                            sums.for_each(|(sum, x)| *sum += x);
                        }
                    }
                    (_, None) => {
                        let first = shaders.element * load.vertices.start;
                        let own = &mut path_bars[first..first + numbers.len()];
                        let bars = own.iter_mut().zip(numbers);
                        // Adding zero removes the sign of zeros.
                        bars.for_each(|(bar, x)| *bar = x + 0.0);
                    }
                }
            })?;
        }
        Ok(())
    }

    /// Splits paths into loads, each of which fits the buffers with `per_vertex` numbers per vertex.
    fn loads(
        &self,
        shaders: &GeneratedFold,
        offsets: &[usize],
        per_vertex: usize,
    ) -> Result<Vec<PathLoad>, Error> {
        let numbers = self.inner.most_bytes as usize / 4;
        let most_vertices = numbers / per_vertex;
        let per_path = shaders.shared.max(shaders.out).max(shaders.context).max(1);
        // Minus one, since there is one offset more than there are paths.
        let most_paths = (numbers / per_path)
            .saturating_sub(1)
            .min(MOST_GROUPS * GROUP);
        let mut loads = Vec::new();
        let mut start = 0;
        let paths = offsets.len() - 1;
        while start < paths {
            let rest = &offsets[start + 1..=paths.min(start + most_paths)];
            let fitting = rest.partition_point(|&end| end - offsets[start] <= most_vertices);
            if fitting == 0 {
                let vertices = offsets[start + 1] - offsets[start];
                // If buffers have fewer than `2 * per_path` numbers, `most_paths` is zero and even one path does not
                // fit.
                return Err(self
                    .inner
                    .too_large((vertices * per_vertex).max(2 * per_path)));
            }
            loads.push(PathLoad {
                paths: start..start + fitting,
                vertices: offsets[start]..offsets[start + fitting],
            });
            start += fitting;
        }
        Ok(loads)
    }

    /// Uploads paths: offsets, vertices, and context and reference of every path.
    fn upload(
        &self,
        shaders: &GeneratedFold,
        load: &PathLoad,
        listed: &PathList<'_>,
        shared: &[f32],
    ) -> [wgpu::Buffer; 3] {
        let inner = &self.inner;
        let (paths, base) = (&load.paths, load.vertices.start);
        let own = &listed.offsets[paths.start..=paths.end];
        let own: Vec<u32> = own.iter().map(|&at| (at - base) as u32).collect();
        let points = listed.vertices(&load.vertices, shaders.element);
        [
            inner.stored(&own),
            inner.stored(&points[..]),
            inner.stored(&shared[paths.start * shaders.shared..paths.end * shaders.shared]),
        ]
    }
}

/// Returns the workgroups for `paths` paths.
fn groups(paths: usize) -> [u32; 2] {
    [paths.div_ceil(GROUP) as u32, 1]
}
