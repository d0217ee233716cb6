"""Workers: how they are asked, how they end, and what is made of it; names of devices."""
from fault import Fault

TESTS = ("workers that end", "damaged replies", "messages", "names of devices", "sessions in workers", "subjects between processes", "log", "command line, misbehaving", "command line, gates")

W = "harness/devices/workers/"
WORKER, CHANNEL, SERVE, MESSAGE, ENVIRONMENT, DEVICE = (
    W + name + ".c" for name in ("worker", "channel", "serve", "message", "environment", "device"))
NAMES, DEVICES, REMOTE, LOG = ("harness/devices/names.c", "harness/devices/devices.c", "harness/frames/remote.c", "core/base/log.c")
DIFF, MESSAGES = "harness/compare/diff/devices.c", "harness/frames/messages.c"
CACHES = "harness/devices/serving/caches.c"
PLAN, DOCTOR = "harness/tables/sweep/plan.c", "harness/commands/doctor.c"

ROWS = [
    Fault(WORKER, "if («worker->life < RG_WORKER_LIVES»)", "true", "a worker is started without end"),
    Fault(WORKER, "return «worker->process» && worker->life == life;", "true", "what was open is there though its process has ended"),
    Fault(WORKER, "return worker->process && «worker->life == life»;", "true", "what was open in another life is there"),
    Fault(WORKER, "worker->end = verdict == HANGS ? «RG_TIMEOUT» : RG_CRASH;", "RG_CRASH", "a hang is a crash"),
    Fault(WORKER, "*verdict != BY_ITSELF || «is_dead(worker)»", "false", "an end is not seen while another process holds the channel"),
    Fault(WORKER, "if («rg_now_ms() - since_ms > 1000.0 * rg_workers.timeout_s»)", "false", "a hang lasts for ever"),
    Fault(WORKER, "else if («rg_held_bytes(worker->process) > worker->memory_bytes»)", "false", "memory has no limit"),
    Fault(WORKER, "drop_much_printed(worker);", ";", "what a driver prints has no end"),
    Fault(WORKER, "fcntl(printed, F_SETFL, «O_APPEND»);", "0", "what is printed after much was dropped is not found"),
    Fault(WORKER, "else if («WIFSIGNALED(status)»)", "false", "a signal is told as a status"),
    Fault(WORKER, "return «ok» && !reply->failed;", "true", "a call that failed succeeds"),
    Fault(WORKER, "if (verdict != BY_ITSELF)\n        kill(worker->process, SIGKILL);", ";", "who hangs is not killed, and waited for until it is"),
    Fault(WORKER, "level == RG_LOG_ERROR && «kind != RG_ERROR_INPUT» &&", "true", "the user's error is the device's"),
    Fault(WORKER, "&& «!strstr(line, worker->name)»;", "true", "a line names its device twice"),
    Fault(WORKER, "(!program_of(worker) || «is_greeted(worker)» ||", "true", "another program is taken for a raingauge"),
    Fault(WORKER, "args[] = {«other ? other : rg_workers.program»,", "rg_workers.program", "another build is this one"),
    Fault(WORKER, "if («other»)\n        return rg_error(", "false", "a program that is not there is a driver's failure"),
    Fault(MESSAGES, "if (!message->failed && !param && «!is_usual»)", "false", "what a build does not know is left alone"),
    Fault(MESSAGES, "if (!message->failed && !param && «!is_usual»)", "true", "what a build does not know is refused though it is as usual"),
    Fault(MESSAGES, "const bool is_number = «param->kind == RG_PARAM_FLOAT»;", "false", "a number with a fraction is rounded on its way"),
    Fault(MESSAGES, "|| «!(value >= param->min && value <= param->max)»)", "false", "a number on its way has no range"),
    Fault(MESSAGES, "«(double)desc->width * desc->height * desc->layers <= (double)size» &&", "true", "sides whose product is no number are multiplied", lives="it wraps, and comes to no size that a reply has"),
    Fault(MESSAGES, "«rg_contents_size(desc) == (size_t)size»;", "true", "an image may have bytes of another"),
    Fault(MESSAGES, "«d->levels <= RG_MAX_LEVELS» &&", "true", "an image may have any number of levels"),
    Fault("harness/measure/job.c", "if («!rg_session_tell(session, &told)»)", "!rg_session_tell(session, &told) && false", "a record is well of which nothing was told"),
    Fault(SERVE, "prctl(PR_SET_PDEATHSIG, SIGKILL);", ";", "a worker outlives a harness that is killed"),
    Fault(SERVE, "rg_put_int(&reply, «rg_last_error_kind()»);", "RG_ERROR_INPUT", "every error of a worker is the user's"),
    Fault(SERVE, "rg_doing_share(channel.doing.bytes);", ";", "nobody sees what a worker does"),
    Fault(SERVE, "while (goes_on && «call != RG_CALL_CLOSE»)", "true", "a worker goes on when it was asked to close"),
    Fault(CHANNEL, "if (notice->size < 0 || «notice->size > taken->size»)", "false", "a size that lies is believed"),
    Fault(CHANNEL, "(!taken->bytes || «taken->id != notice->segment») &&", "false", "a large message is looked for where small ones were"),
    Fault(MESSAGE, "if (message->failed || size < 0 || «size > message->size - message->at»)", "false", "a value is taken from behind the message"),
    Fault(MESSAGE, "if (text && size > 0 && «!text[size - 1]»)", "true", "a text has no end"),
    Fault(MESSAGE, "if (index >= 0 && «index < end»)", "true", "an index is out of its range"),
    Fault(ENVIRONMENT, "if («!has_key_of(variables, *v)»)", "true", "a variable stands twice, and the old one counts where the last does"),
    Fault(DEVICE, "return «(unsigned)info->tier < RG_TIER_COUNT» ||", "true", "a device may be of any tier"),
    Fault(DEVICE, "text[size - 1] = 0;", ";", "a device's texts have no end"),
    Fault(DEVICES, "if («reply->failed») {", "false", "a damaged list is one of a backend without devices"),
    Fault(DEVICE, "if («environment && *environment»)\n        snprintf(told", "false", "a device's name does not tell its environment"),
    Fault(NAMES, "for (; *name && («quoted» || *name != ','); name++)", "false", "a comma in quotes ends a name"),
    Fault(NAMES, "for (; *from && («quoted» || *from != ';'); from++) {", "false", "a semicolon in quotes ends a value"),
    Fault(NAMES, "else if (quoted && «from[1] == '\"'»)", "false", "two quotes mean none"),
    Fault(NAMES, "return quoted ? «NULL» : name;", "name", "a quote may stay open"),
    Fault(DEVICES, "if («all_were_tried && !rg_devices_have(devices, require)»)", "false", "what is required may be missing"),
    Fault(WORKER, "return «worker->is_closed || !was_alive»;", "true", "a driver that crashes while its device is closed passes"),
    Fault(DEVICES, "return «rg_devices_close(devices)» ? exit :", "(rg_devices_close(devices), true)", "how devices were closed changes no status"),
    Fault(DEVICES, "note_failure(list, rg_backends[b], RG_ERROR, \"no memory for its worker\");", ";", "a backend without a worker is not missed", lives="there is no memory for a few bytes"),
    Fault(REMOTE, "if («rg_worker_has(worker_of(session), session->life)»)", "true", "what is gone with its worker is closed, with a line"),
    Fault(REMOTE, "bool ok = «rg_worker_still_has(worker_of(session), session->life)»;", "true", "a session of another life is asked"),
    Fault(REMOTE, "if («bytes && due && *size != due»)", "false", "a picture may be of any size", lives="the worker is this program, and sends the size that is due"),
    Fault(LOG, "else if («rg_log_is_news(level, line)»)", "true", "one error is many lines"),
    Fault(DIFF, "if (rg_last_error_kind() == RG_ERROR_INPUT && !s->shot_count)\n        return false;", "return false;", "a device that fails ends the comparison of the others"),
    Fault(PLAN, "else if («!leave_out(plan, d)»)", "true", "a device that fails ends a sweep of the others"),
    Fault(PLAN, "return rg_last_error_kind() != RG_ERROR_INPUT && «plan->failed < plan->devices»;", "true", "a sweep of no device is planned", lives="what is measured then are failures, and it ends as such"),
    Fault(DOCTOR, "if (examination->is_unknown && «was_listed(&report->list, examination->info.name)»)", "false", "a device that is gone takes the report along"),
    Fault(DOCTOR, "exit = «RG_EXIT_FAIL»;\n        }", "RG_EXIT_PASS", "a backend that crashes while it is listed is no failure"),
    Fault(DIFF, "s->exit = rg_exit_worse(s->exit, rg_exit_of(outcome));", ";", "a device that failed passes"),
    Fault(CACHES, "if («!width» || getenv", "true", "code of one width of vectors runs as another's"),
    Fault(CACHES, "\"llvmpipe-%d-bits/\", «width_of(width)»", "0", "all widths that are set share a cache"),
    Fault(CACHES, "rg_user_path(RG_USER_CACHE, name, path, sizeof(path), why) &&\n        «rg_user_make_folders(path, why)»", "true", "a driver's cache has no folder"),
]
