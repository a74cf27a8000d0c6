//! What can go wrong in the solver, with the place and the mend.

use thiserror::Error;

/// Result of a solver operation.
pub type Result<T> = std::result::Result<T, Error>;

/// A failure of the solver: always names the part, element, bond or row, and says what to do.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// A material constant outside its physical range.
    #[error("{what}: {name} = {value} is not allowed; {mend}")]
    Material {
        /// Whose constant it is, e.g. `material 'steel'`.
        what: String,
        /// Name of the constant.
        name: &'static str,
        /// The offending value.
        value: f64,
        /// What to change.
        mend: &'static str,
    },
    /// An element whose Jacobian is not positive at an integration point.
    #[error(
        "body '{body}': element {element} is inverted or flat (Jacobian {jacobian:.3e}); check the order and position of its nodes {nodes:?}"
    )]
    InvertedElement {
        /// Name of the body.
        body: String,
        /// Index of the element.
        element: usize,
        /// Smallest Jacobian found.
        jacobian: f64,
        /// Its nodes.
        nodes: Vec<usize>,
    },
    /// A formulation that does not exist for this kind of element or stress state.
    #[error("body '{body}': {message}")]
    Formulation {
        /// Name of the body.
        body: String,
        /// What does not fit, and what does.
        message: String,
    },
    /// A request about a shape, packing or lattice that cannot be met.
    #[error("{what}: {message}")]
    Geometry {
        /// The body, lattice or packing.
        what: String,
        /// What is wrong and what to do.
        message: String,
    },
    /// A bond that cannot carry load: coincident ends, unknown particle, NaN stiffness.
    #[error("body '{body}': bond {bond} between particles {i} and {j}: {message}")]
    Bond {
        /// Name of the body.
        body: String,
        /// Index of the bond.
        bond: usize,
        /// First particle.
        i: usize,
        /// Second particle.
        j: usize,
        /// What is wrong and what to do.
        message: String,
    },
    /// Particles that hang on nothing.
    #[error(
        "body '{body}': {count} particle(s) not connected to any support or tie, first ones {first:?}; bond them, tie them or leave them out"
    )]
    Disconnected {
        /// Name of the body.
        body: String,
        /// How many.
        count: usize,
        /// The first few.
        first: Vec<usize>,
    },
    /// A model that can move without resistance.
    #[error("the model is a mechanism: {what}; {mend}")]
    Mechanism {
        /// Which bodies move, and how.
        what: String,
        /// What to do.
        mend: String,
    },
    /// Two bodies that occupy the same space.
    #[error(
        "bodies '{first}' and '{second}' overlap by {overlap:.3e} m; the coupling is non-overlapping: they may only share a face"
    )]
    Overlap {
        /// One body.
        first: String,
        /// The other.
        second: String,
        /// Depth of the overlap in metres.
        overlap: f64,
    },
    /// A tie with nothing to tie.
    #[error("tie '{tie}': empty interface: {message}")]
    EmptyInterface {
        /// Name of the tie.
        tie: String,
        /// Which side is empty and what to do.
        message: String,
    },
    /// Constraints that contradict each other.
    #[error("constraint '{row}' contradicts the others by {gap:.3e}; remove one of: {others}")]
    Contradiction {
        /// Label of the row.
        row: String,
        /// By how much it is violated when the others hold.
        gap: f64,
        /// The rows it depends on.
        others: String,
    },
    /// Elements that cannot be replaced by particles, or a criterion that cannot say which.
    #[error("{what}: {message}")]
    Switch {
        /// The body, region or criterion.
        what: String,
        /// What is wrong and what to do.
        message: String,
    },
    /// A linear solve that failed or is not accurate enough to be used.
    #[error("linear solve: {message}")]
    Solve {
        /// What happened and what to do.
        message: String,
    },
    /// A load history that cannot act as it should.
    #[error("{what}: {message}")]
    Load {
        /// Which load.
        what: String,
        /// What is wrong and what to do.
        message: String,
    },
    /// A time step at which explicit integration would blow up.
    #[error(
        "time step {step_s:.6e} s is beyond the critical {critical_s:.6e} s set by {what}; take at most the critical step"
    )]
    UnstableStep {
        /// The step asked for, in s.
        step_s: f64,
        /// The safe bound on the critical step, in s.
        critical_s: f64,
        /// The element or bond that sets it.
        what: String,
    },
    /// Bytes from which a run cannot go on.
    #[error("checkpoint: {message}")]
    Checkpoint {
        /// What is wrong and what to do.
        message: String,
    },
    /// A file that cannot be read.
    #[error("{file}{}: {message}", line.map(|l| format!(":{l}")).unwrap_or_default())]
    File {
        /// Path as given.
        file: String,
        /// Line, where known.
        line: Option<usize>,
        /// What is wrong and what to do.
        message: String,
    },
}
