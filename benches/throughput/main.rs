//! What a pose, a target and a file cost. `docs/performance.md` has the figures and what they were taken on.
//!
//!     cargo bench --bench throughput              # everything
//!     cargo bench --bench throughput kinematics   # forward and inverse, with rs-opw-kinematics beside it
//!     cargo bench --bench throughput correction   # single poses of the real arm, whole files, stages
//!     cargo bench --bench throughput identification   # Jacobian, identification, calibration of 500 poses
//!
//! Large programs and identification use all cores there are; RAYON_NUM_THREADS=1 makes that one.

mod arms;
mod correction;
mod identification;
mod kinematics;
mod programs;

fn main() {
    divan::main();
}
