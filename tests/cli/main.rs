//! The program as a user runs it: what it prints, where, with which exit status, and which files are there afterwards.

#![allow(clippy::expect_used, reason = "a test may stop where its own preparation fails")]

mod bad_input;
mod batch;
mod bench;
mod jobs;
mod library;
mod main_job;
mod modules;
mod outputs;
mod singular;
mod talk;
mod watch;
mod whole_loop;
