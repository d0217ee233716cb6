"""raingauge's plan under ReFrame: a test for each shard, on exclusive nodes. Merge by hand afterwards, so that a shard that fails hides no other."""
import reframe as rfm
import reframe.utility.sanity as sn

SHARDS = 8


@rfm.simple_test
class RaingaugeShard(rfm.RunOnlyRegressionTest):
    shard = parameter(range(1, SHARDS + 1))
    folder = variable(str, value="/shared/raingauge")  # with plan.json, made by `raingauge plan --shards 8`
    valid_systems, valid_prog_environs = ["*"], ["*"]
    executable = "raingauge"
    exclusive_access = True

    @run_before("run")
    def measure(self):
        self.prerun_cmds = ["raingauge doctor --prologue || exit"]
        self.executable_opts = ["table", "--plan", f"{self.folder}/plan.json", "--shard", f"{self.shard}/{SHARDS}", "-o", f"{self.folder}/records"]

    @sanity_function
    def ended(self):
        return sn.assert_found(rf"shard {self.shard} of {SHARDS}: \d+ of \d+ groups were there", self.stderr)
