// HapticClient: touch from C#, without native code and without packages: the protocol of docs/protocol.md over a
// WebSocket. One file to copy, hence its length; C# 7 and .NET Standard 2.0, so .NET, Mono and Unity take it.
// docs/csharp.md is the guide.
//
// Messages are written in protobuf's binary form, by hand: smaller than JSON, no decimal commas of the machine's
// language, and a field that a newer server adds is skipped by its length.
//
// Units: metre, newton, second. Frames: right-handed, world. No call waits for the network. All calls: any thread.
using System;
using System.Collections.Generic;
using System.Net.WebSockets;
using System.Text;
using System.Threading;
using System.Threading.Tasks;

namespace HL {
    public struct Vec3 {
        public double X, Y, Z;
        public Vec3(double x, double y, double z) { X = x; Y = y; Z = z; }
    }

    /// <summary>Vertices, and lists of their numbers from 0. Copied when it is given to the client.</summary>
    public sealed class TouchMesh {
        public double[] Vertices;   // x y z each, m
        public double[] Normals;    // x y z each, or null: flat
        public double[] TexCoords;  // u v each, or null
        public int[] Triangles;     // three each; both sides are touched
        public int[] Segments;      // two each
        public int[] Points;        // one each
    }

    /// <summary>How a surface feels. Null: as the call that places it says; at last the server's default.</summary>
    public sealed class TouchMaterial {
        public double? Stiffness;        // 0..1
        public double? StaticFriction;   // >= 0
        public double? DynamicFriction;  // >= 0
        public double? Viscosity_Ns_m;   // >= 0
        public double? Stribeck_m_s;     // >= 0
        public double? Presliding_N_m;   // >= 0
        public double? Adhesion_N;       // >= 0
        public double? Compliance_m_N;   // >= 0
        public double? Strength_N;       // >= 0; 0: never pierced
        public bool? Flat;               // true: normals are ignored
    }

    /// <summary>A field of heights, or what a depth camera sees: docs/heights.md, docs/depth.md.</summary>
    public sealed class TouchHeights {
        public Array Samples;      // short[], ushort[] or float[], row by row
        public int Columns;
        public double Spacing = 1;       // m between columns, and between rows
        public double VerticalScale = 1; // m for a unit of the samples
        public double? Missing;    // sample that stands for none
        public double[] Camera;    // fx fy cx cy in pixels: the samples are depths, and have no spacing; null: heights
        public double Join = 0.02; // depths that differ by more than this part are not joined
        public double Smoothing;   // 0..1: part of what the object showed before that stays
    }

    /// <summary>A surface of a volume, where its values are Iso: docs/volumes.md.</summary>
    public sealed class TouchVolume {
        public Array Samples;      // short[], ushort[] or float[], along x first, then y, then z
        public int Width, Height;  // samples along x and y
        public double Spacing = 1; // m between samples
        public double? Missing;    // sample that stands for none
        public double Iso;
        public bool Below;         // the matter is where values are below Iso, as of signed distances
    }

    /// <summary>A cloud of points: docs/clouds.md.</summary>
    public sealed class TouchCloud {
        public double[] Points;    // x y z each, m
        public float[] Normals;    // x y z each, of either sign; null: from the nearest points
        public byte[] Colours;     // red, green, blue of each, which pages show; null: none
        public double Reach;       // of a small disc around each, in distances between neighbours; 0: points alone
    }

    /// <summary>A solid that is written down, of others: docs/implicit.md. Metres. It is scaled, then turned, then moved,
    /// each once, in whatever order these are called; they give another solid.</summary>
    public sealed class Solid {
        internal readonly int Kind;         // number of the field of Expression
        internal readonly Writer Numbers;   // its message
        internal Vec3? Place, Axis;
        internal double? Degrees, Factor;

        Solid(int kind, Writer numbers) { Kind = kind; Numbers = numbers; }

        public static Solid Sphere(double radius) { return new Solid(1, new Writer().Double(1, radius)); }
        public static Solid Box(Vec3 size, double edgeRadius = 0) {
            return new Solid(2, new Writer().Vector(1, size).Double(2, edgeRadius));
        }
        public static Solid Cylinder(double radius, double length) { return Round(3, radius, length); }  // along z
        public static Solid Capsule(double radius, double length) { return Round(4, radius, length); }   // of its axis
        public static Solid Torus(double radius, double tube) { return Round(5, radius, tube); }         // around z
        /// <summary>What is below a plane, by its outward normal and its distance from the origin.</summary>
        public static Solid HalfSpace(Vec3 normal, double distance = 0) {
            return new Solid(6, new Writer().Vector(1, normal).Double(2, distance));
        }
        /// <summary>A wall of this thickness; 0: the solid on one side.</summary>
        public static Solid Gyroid(double period, double thickness = 0) { return Round(7, period, thickness); }

        public static Solid Union(params Solid[] of) { return Of(8, of, 0); }
        public static Solid Intersection(params Solid[] of) { return Of(9, of, 0); }
        /// <summary>The first without the others.</summary>
        public static Solid Difference(params Solid[] of) { return Of(10, of, 0); }
        // `smooth`: distance over which surfaces blend, m.
        public static Solid SmoothUnion(double smooth, params Solid[] of) { return Of(8, of, smooth); }
        public static Solid SmoothIntersection(double smooth, params Solid[] of) { return Of(9, of, smooth); }
        public static Solid SmoothDifference(double smooth, params Solid[] of) { return Of(10, of, smooth); }
        /// <summary>Half of the thickness on each side of the surface.</summary>
        public static Solid Shell(Solid of, double thickness) { return Around(11, of, thickness); }
        /// <summary>Each face goes outward, or inward where the distance is negative.</summary>
        public static Solid Offset(Solid of, double distance) { return Around(12, of, distance); }

        public Solid At(double x, double y, double z) {
            Solid moved = Copy();
            moved.Place = new Vec3(x, y, z);
            return moved;
        }
        public Solid Turned(Vec3 axis, double degrees) {
            Solid turned = Copy();
            turned.Axis = axis;
            turned.Degrees = degrees;
            return turned;
        }
        public Solid Scaled(double factor) {
            Solid scaled = Copy();
            scaled.Factor = factor;
            return scaled;
        }

        Solid Copy() { return (Solid)MemberwiseClone(); }

        static Solid Round(int kind, double first, double second) {
            return new Solid(kind, new Writer().Double(1, first).Double(2, second));
        }
        static Solid Of(int kind, Solid[] of, double smooth) {
            var numbers = new Writer();
            foreach (Solid solid in of) numbers.Nested(1, Messages.Expression(solid));
            return new Solid(kind, numbers.Double(2, smooth));
        }
        static Solid Around(int kind, Solid of, double length) {
            return new Solid(kind, new Writer().Nested(1, Messages.Expression(of)).Double(2, length));
        }
    }

    /// <summary>The surface of a solid that is written down: docs/implicit.md.</summary>
    public sealed class TouchImplicit {
        public Solid Solid;
        public Vec3? Low, High;    // corners of a box where it ends; both null: around the solid, if that has an end
        public double? Error;      // m, that triangles may be from the surface; null: 1e-5
    }

    /// <summary>A mesh, heights, a volume, a cloud, an implicit surface, or a call of an object by its number; placed by
    /// a matrix.</summary>
    public sealed class TouchItem {
        public TouchMesh Mesh;
        public TouchHeights Heights;
        public TouchVolume Volume;
        public TouchCloud Cloud;
        public TouchImplicit Implicit;
        public uint Object;        // > 0: a call, and nothing else
        public double[] Matrix;    // 16 numbers, column by column, last row 0 0 0 1; null: identity
        public TouchMaterial Material;
        public uint? Name;         // reported when it is touched
    }

    public struct Rotation {       // a quaternion
        public double X, Y, Z, W;
        public Rotation(double x, double y, double z, double w) { X = x; Y = y; Z = z; W = w; }
    }

    public enum BodyShape { Hull, Box, Ball, Capsule, Cylinder, Parts }

    /// <summary>How the calls of an object move as rigid bodies: docs/bodies.md. Null: the server's default.</summary>
    public sealed class TouchBody {
        public bool Fixed;               // only frames move it
        public double? Mass_kg;          // null: of its volume and density
        public double? Density_kg_m3;    // null: 1000
        public BodyShape Shape;          // by which it meets bodies and scene; the hand feels the mesh
        public double? StaticFriction, DynamicFriction;  // with other bodies
        public double? Restitution;      // 0..1
        public Vec3? Velocity_m_s, Spin_rad_s;           // at the start, world
    }

    /// <summary>A place of an object that holds the proxy until it is pulled off: docs/snaps.md.</summary>
    public sealed class TouchSnap {
        public double[] Points;    // x y z each, m, frame of the object: a point, or the corners of a curve
        public Vec3? Normal;       // of the plane through the one point; null: no plane
        public double Capture;     // m of the world, from which the proxy goes there
        public double Release_N;
    }

    public enum FieldKind { Magnet, Spring, Constant, Drag }

    /// <summary>A force on the hand from a place of an object: docs/fields.md.</summary>
    public sealed class TouchField {
        public FieldKind Kind;
        public double[] Points;    // as TouchSnap
        public Vec3? Normal;
        public double Reach;       // m of the world; farther away there is no force
        public double? Force_N;    // the greatest; of a spring null: no limit
        public double? Stiffness_N_m;  // of a spring
        public double? Damping_Ns_m;   // of a drag
        public Vec3? Direction;    // of a constant force
    }

    /// <summary>All that an object can be. A body has one item, with a mesh.</summary>
    public sealed class TouchObject {
        public TouchItem[] Items = new TouchItem[0];
        public TouchBody Body;     // null: it moves as frames say
        public TouchSnap[] Snaps = new TouchSnap[0];
        public TouchField[] Fields = new TouchField[0];
    }

    public enum JointKind { Ball, Hinge, Slider, Fixed, Distance }

    /// <summary>Joins two bodies that the world calls, or one to the world: docs/bodies.md. Metres and newtons; of a
    /// hinge radians and N m. Coordinates count from where the calls place the bodies.</summary>
    public sealed class TouchJoint {
        public uint Id;            // > 0
        public JointKind Kind;
        public uint ObjectA, ObjectB;    // ObjectB 0: the world
        public uint? NameA, NameB;       // of the calls; null: the object is called once
        public Vec3 Anchor, AnchorB;     // world; AnchorB: of a distance
        public Vec3? Axis;         // of a hinge or slider
        public double? Low, High;  // null: no limit
        public double Rest, Spring, Damping, Friction;
        public double[] TablePositions, TableForces;     // a force over the coordinate, or null
        public bool Collide;       // whether the two also collide with each other
    }

    /// <summary>Settings of the device, for its master. Null: unchanged.</summary>
    public sealed class DeviceSettings {
        public double? ProxyRadius;      // m, world
        public Vec3? WorkspaceOrigin;    // of the hand's space, world
        public double WorldPerDevice = 1;  // m of world per m of hand; used with WorkspaceOrigin
        public double? Stiffness_N_m;
        public Vec3? HandGoal;           // simulated devices
        public Rotation? HandTurn;       // simulated devices with a wrist: how the stylus is to be turned
        public double? HandGripper_rad;  // simulated devices with a gripper: how far it is to be open
        public bool Rearm;               // leave the fault

        // What this and then `later` change.
        internal DeviceSettings With(DeviceSettings later) {
            return new DeviceSettings {
                ProxyRadius = later.ProxyRadius ?? ProxyRadius,
                WorkspaceOrigin = later.WorkspaceOrigin ?? WorkspaceOrigin,
                WorldPerDevice = later.WorkspaceOrigin.HasValue ? later.WorldPerDevice : WorldPerDevice,
                Stiffness_N_m = later.Stiffness_N_m ?? Stiffness_N_m,
                HandGoal = later.HandGoal ?? HandGoal,
                HandTurn = later.HandTurn ?? HandTurn,
                HandGripper_rad = later.HandGripper_rad ?? HandGripper_rad,
                Rearm = later.Rearm || Rearm
            };
        }
    }

    public struct Touched {
        public uint Object, Name, Session;
        public Vec3 Point, Normal;
    }

    /// <summary>The part of the device that the hand holds. Axes of the world.</summary>
    public struct Stylus {
        public Rotation Turned;    // 0 0 0 1: its shaft lies along +z, or the device has no wrist
        public Vec3 Spin_rad_s;
        public double Gripper_rad; // how far the gripper is open
        public double Gripper_N;   // with which the hand closes it; 0: the device does not report it
    }

    /// <summary>A rigid body of this client after the last step. World frame.</summary>
    public struct BodyState {
        public uint Object, Name;
        public Vec3 Position;      // of the object frame
        public Rotation Rotation;  // unit
        public Vec3 Velocity_m_s, Spin_rad_s;
    }

    /// <summary>A joint of this client after the last step; forces are those on its body a.</summary>
    public struct JointState {
        public uint Id;
        public double Coordinate, Velocity, Force;
        public Vec3 Held_N;
    }

    /// <summary>A hand of another server of a shared world. World frame.</summary>
    public struct RemoteHand {
        public string Server, Device;  // Device "": that server has one
        public Vec3 Finger, Proxy, Force_N;
        public double ProxyRadius;
        public uint Buttons, Contacts;
        public Stylus? Stylus;         // null: its device has neither wrist nor gripper
    }

    /// <summary>The snap that holds the proxy.</summary>
    public struct HoldingSnap {
        public uint Object, Name, Session;
        public uint Number;        // among the snaps of the object, from 0
    }

    public enum Safety { Off, Arming, On, Fault, Waiting }

    /// <summary>The device and the proxy at one moment. Never changes once made.</summary>
    public sealed class TouchState {
        public double Time_s;      // server's clock
        public Vec3 Finger, Proxy, Force_N;
        public Touched[] Touched;
        public Safety Safety;
        public string Fault = "";
        public uint Buttons;       // bit i: button i is down
        public Stylus? Stylus;     // null: the device has neither wrist nor gripper
        public double ProxyRadius;
        public bool Master;
        public BodyState[] Bodies;     // once a frame with a body has been sent
        public JointState[] Joints;
        public HoldingSnap? Snap;
        public RemoteHand[] RemoteHands;
    }

    public enum TouchEventKind { Touch, Untouch, Button, FrameShown, Warning, Refused, Sleep, Wake, Impact }

    public sealed class TouchEvent {
        public TouchEventKind Kind;
        public double Time_s;
        public uint Object, Name;  // Touch, Untouch, Sleep, Wake, Impact
        public Vec3 Position;      // of the proxy; Sleep, Wake, Impact: of the body's centre of mass
        public double Impulse_N_s; // Impact
        public uint Button;
        public bool Down;
        public ulong Frame;        // FrameShown, Warning, Refused
        public string Text = "";   // Warning, Refused: one line
    }

    public sealed class ClientOptions {
        public string Name = "C#";       // for the server's logs
        public string Token = "";        // where the server asks for one
        public uint Device;              // number of one of several
        public string DeviceLabel = "";  // its name at the server, such as left, in the place of the number
        public bool Master = true;       // wants to set the device; the first client gets it
        public bool KeepObjects;         // objects stay touchable when this client has gone
        public double StateRate_Hz = 60;
        public double Timeout_s = 10;    // for the welcome
        public bool BodyEvents;          // Sleep, Wake and Impact are sent
        public double ImpactsAbove_N_s;  // smaller ones are not
    }

    public enum ClientStatus { Connecting, Open, Closed }

    public sealed class HapticClient : IDisposable {
        const int MaxUnanswered = 16;    // frames; with more the server is still building, and the next one waits
        const int MaxEvents = 4096;      // events that nobody takes; then the oldest go
        const int MaxCommands = 1024;    // to bodies, not sent; then a call throws
        const int MaxReplyBytes = 1 << 24;
        const int CloseWait_ms = 2000;

        readonly object gate = new object();
        readonly ClientWebSocket socket = new ClientWebSocket();
        readonly CancellationTokenSource stop = new CancellationTokenSource();
        readonly SemaphoreSlim wake = new SemaphoreSlim(0);
        readonly Queue<TouchEvent> events = new Queue<TouchEvent>();
        readonly ClientOptions options;
        readonly Uri address;
        Draft drawing = new Draft();     // since the last Flush
        Draft waiting = new Draft();     // flushed, not sent
        DeviceSettings setting;          // not sent; null: none
        readonly Queue<byte[]> commands = new Queue<byte[]>();  // to bodies, not sent
        bool bodiesAsked;                // the server has been asked to send bodies
        ulong sent, answered, nextUpload = 1;
        ulong messageLimit = 1 << 22;
        double frameLimit_Hz = 250;
        bool disposed;
        Task leftAlone;                  // an attempt to connect that was given up
        volatile ClientStatus status = ClientStatus.Connecting;
        volatile string reason = "";
        volatile TouchState newest;

        /// <summary>Begins to connect, and returns at once. `url`: ws:// or wss://HOST:PORT/hl, or hl:// or
        /// hls://HOST[:PORT]; "?token=..." may follow. ArgumentException: it is none.</summary>
        public HapticClient(string url, ClientOptions options = null) {
            this.options = options ?? new ClientOptions();
            string token = this.options.Token;
            address = Address.Parse(url, ref token);
            stop.CancelAfter(TimeSpan.FromSeconds(this.options.Timeout_s));
            Ended = Task.Run(() => Converse(token));
        }

        public ClientStatus Status { get { return status; } }
        /// <summary>Why it is closed, in one line; "" before.</summary>
        public string Reason { get { return reason; } }
        /// <summary>The newest state; null before the first.</summary>
        public TouchState Newest { get { return newest; } }
        /// <summary>Ends when the conversation has; never fails. To connect again, make another client.</summary>
        public Task Ended { get; private set; }

        /// <summary>Defines or overwrites object `id` > 0 in the next frame.</summary>
        public void Define(uint id, params TouchItem[] items) { Define(id, new TouchObject { Items = items }); }

        /// <summary>The same with a body, snaps and fields.</summary>
        public void Define(uint id, TouchObject defined) {
            if (id == 0) throw new ArgumentException("the number of an object is above 0");
            lock (gate) {
                Content content = Content.Of(defined.Items, 2, ref nextUpload);
                drawing.ForgetIsos(id);
                content.Items.Append(Messages.Extras(defined));
                content.HasBody = defined.Body != null;
                drawing.Objects[id] = content;
            }
        }

        /// <summary>Deletes object `id` in the next frame.</summary>
        public void Delete(uint id) { lock (gate) { drawing.ForgetIsos(id); drawing.Objects[id] = null; } }

        /// <summary>Another iso value for item `item` of object `id`, a surface of a volume, in the next frame. Nothing
        /// is sent again.</summary>
        public void ChangeIso(uint id, int item, double iso) {
            lock (gate) drawing.Isos[Tuple.Create(id, item)] = iso;
        }

        /// <summary>What the world consists of from the next frame on.</summary>
        public void SetWorld(params TouchItem[] items) { SetWorld(new TouchJoint[0], items); }

        /// <summary>The same with joints between the bodies that it calls. While a joint's number, kind and bodies stay
        /// the same, it goes on from where it is.</summary>
        public void SetWorld(TouchJoint[] joints, params TouchItem[] items) {
            lock (gate) {
                Content content = Content.Of(items, 1, ref nextUpload);
                foreach (TouchJoint joint in joints) content.Items.Nested(2, Messages.Joint(joint));
                drawing.World = content;
            }
        }

        /// <summary>The acceleration of all bodies of the server, m/s^2, from the next frame on.</summary>
        public void SetGravity(Vec3 acceleration) { lock (gate) drawing.Gravity = acceleration; }

        /// <summary>Gives bodies of `body`, an object that is shown, an impulse, N s, evenly within so many seconds, at
        /// a point of the world, m (null: at the centre of mass). At once, not with the frame. `name`: only those that
        /// are called with it. InvalidOperationException: 1024 commands wait to be sent.</summary>
        public void Push(uint body, Vec3 impulse, Vec3? at = null, double seconds = 0, uint? name = null) {
            Writer push = new Writer().Nested(1, Messages.Vector(impulse)).Vector(2, at).Double(3, seconds);
            Command(body, name, 3, push);
        }

        /// <summary>Sets their velocity, m/s, and spin, rad/s, in the world; null: unchanged. Else as Push.</summary>
        public void SetVelocity(uint body, Vec3? velocity, Vec3? spin = null, uint? name = null) {
            Command(body, name, 4, new Writer().Vector(1, velocity).Vector(2, spin));
        }

        /// <summary>Places the object frame, m; null: unchanged. Else as Push.</summary>
        public void Place(uint body, Vec3? position, Rotation? rotation = null, uint? name = null) {
            var place = new Writer().Vector(1, position);
            if (rotation.HasValue) place.Nested(2, Messages.Turn(rotation.Value));
            Command(body, name, 5, place);
        }

        void Command(uint body, uint? name, int what, Writer how) {
            Writer command = new Writer().Number(1, body);
            if (name.HasValue) command.Number(2, name.Value);
            command.Nested(what, how);
            lock (gate) {
                if (commands.Count == MaxCommands)
                    throw new InvalidOperationException("too many commands to bodies wait to be sent");
                commands.Enqueue(new Writer().Nested(10, command).ToArray());
            }
            Wake();
        }

        /// <summary>Ends the frame: all that was given since the last is felt at once. While the server cannot take it,
        /// it waits, together with those that follow: the later world, the later definitions.</summary>
        public void Flush() {
            lock (gate) {
                waiting.Merge(drawing);
                drawing = new Draft();
            }
            Wake();
        }

        /// <summary>Changes the device at once, not with the frame. Of what is set faster than it can be sent the
        /// newest goes.</summary>
        public void Set(DeviceSettings changes) {
            lock (gate) setting = (setting ?? new DeviceSettings()).With(changes);
            Wake();
        }

        /// <summary>Takes the oldest event; false: there is none.</summary>
        public bool Poll(out TouchEvent taken) {
            lock (gate) {
                taken = events.Count > 0 ? events.Dequeue() : null;
                return taken != null;
            }
        }

        /// <summary>Sends what is flushed and closes, in the background: see Ended.</summary>
        public void Dispose() {
            lock (gate) {
                if (disposed) return;
                disposed = true;
            }
            if (status == ClientStatus.Closed) return;
            stop.CancelAfter(status == ClientStatus.Open ? CloseWait_ms : 0);
            Wake();
        }

        void Wake() { if (status != ClientStatus.Closed) wake.Release(); }

        // The whole life of the connection, on threads of the pool.
        async Task Converse(string token) {
            string why;
            try {
                await Connect().ConfigureAwait(false);
                await Send(Messages.Open(options, token)).ConfigureAwait(false);
                why = await ReceiveAll().ConfigureAwait(false);
            }
            catch (Exception error) {
                why = Explain(error);
            }
            if (reason.Length == 0) reason = why;
            status = ClientStatus.Closed;
            stop.Cancel();
            if (leftAlone == null) socket.Dispose();
        }

        // An attempt that takes too long is left alone, and its socket goes when it ends: Mono does not heed a token
        // while it waits for the answer to the upgrade, and has failed where the socket was closed under it.
        async Task Connect() {
            Task connected = socket.ConnectAsync(address, CancellationToken.None);
            await Task.WhenAny(connected, Task.Delay(Timeout.Infinite, stop.Token)).ConfigureAwait(false);
            if (connected.IsCompleted) {
                await connected.ConfigureAwait(false);
                stop.Token.ThrowIfCancellationRequested();
                return;
            }
            leftAlone = connected.ContinueWith(ended => {
                if (ended.Exception == null) socket.Abort();
                socket.Dispose();
            });
            throw new OperationCanceledException();
        }

        string Explain(Exception error) {
            if (disposed) return "closed by this program";
            string where = address.Scheme + "://" + address.Authority;
            if (stop.IsCancellationRequested && status == ClientStatus.Connecting)
                return "no welcome from " + where + " within " + options.Timeout_s + " s; is it an HL server?";
            Exception inner = error.GetBaseException();
            string text = inner.Message.Split('\n')[0].Trim();
            return status == ClientStatus.Connecting
                ? "cannot reach " + where + ": " + text + "; is hld running there?"
                : "the connection to " + where + " broke: " + text;
        }

        Task Send(byte[] message) {
            return socket.SendAsync(new ArraySegment<byte>(message), WebSocketMessageType.Binary, true, stop.Token);
        }

        // Returns why the server has closed.
        async Task<string> ReceiveAll() {
            var buffer = new byte[1 << 16];
            int size = 0;
            for (;;) {
                if (size == buffer.Length) Array.Resize(ref buffer, 2 * size);
                if (size > MaxReplyBytes) throw new InvalidOperationException("a reply has more than 16 MiB");
                var part = await socket.ReceiveAsync(new ArraySegment<byte>(buffer, size, buffer.Length - size),
                    stop.Token).ConfigureAwait(false);
                if (part.MessageType == WebSocketMessageType.Close) {
                    string text = part.CloseStatusDescription;
                    return disposed ? "closed by this program"
                        : string.IsNullOrEmpty(text) ? "the server has closed the connection" : text;
                }
                size += part.Count;
                if (!part.EndOfMessage) continue;
                Take(new Reader(buffer, 0, size));
                size = 0;
            }
        }

        // One ServerReply.
        void Take(Reader reply) {
            while (reply.Next()) {
                if (reply.Field == 1) Welcome(reply.Nested());
                else if (reply.Field == 2) Refusal(reply.Nested());
                else if (reply.Field == 4) Shown(reply.Nested());
                else if (reply.Field == 5) newest = Replies.State(reply.Nested());
                else if (reply.Field == 6) Happened(Replies.Event(reply.Nested()));
            }
        }

        void Welcome(Reader welcome) {
            while (welcome.Next()) {
                if (welcome.Field != 6) continue;
                Reader limits = welcome.Nested();
                while (limits.Next()) {
                    if (limits.Field == 1) messageLimit = limits.Number;
                    if (limits.Field == 8 && limits.Double() > 0) frameLimit_Hz = Math.Max(0.01, limits.Double());
                }
            }
            stop.CancelAfter(disposed ? CloseWait_ms : Timeout.Infinite);
            status = ClientStatus.Open;
            Task.Run(SendAll);
        }

        void Refusal(Reader refusal) {
            var refused = new TouchEvent { Kind = TouchEventKind.Refused };
            bool fatal = false;
            while (refusal.Next()) {
                if (refusal.Field == 1) refused.Text = refusal.Text();
                if (refusal.Field == 2) fatal = refusal.Number != 0;
                if (refusal.Field == 3) refused.Frame = refusal.Number;
            }
            if (fatal) reason = refused.Text;
            Answered(refused.Frame);
            Happened(refused);
        }

        void Shown(Reader shown) {
            var frame = new TouchEvent { Kind = TouchEventKind.FrameShown };
            var warnings = new List<string>();
            while (shown.Next()) {
                if (shown.Field == 1) frame.Frame = shown.Number;
                if (shown.Field == 2) frame.Time_s = shown.Double();
                if (shown.Field == 4) warnings.Add(shown.Text());
            }
            Answered(frame.Frame);
            Happened(frame);
            foreach (string text in warnings)
                Happened(new TouchEvent { Kind = TouchEventKind.Warning, Frame = frame.Frame, Text = text });
        }

        void Answered(ulong frame) {
            lock (gate) answered = Math.Max(answered, frame);
            Wake();
        }

        // Motions are left out: the newest state has them.
        void Happened(TouchEvent happened) {
            if (happened == null) return;
            lock (gate) {
                if (events.Count == MaxEvents) events.Dequeue();
                events.Enqueue(happened);
            }
        }

        async Task SendAll() {
            try {
                while (await SendWhatThereIs().ConfigureAwait(false))
                    await wake.WaitAsync(stop.Token).ConfigureAwait(false);
                await socket.CloseOutputAsync(WebSocketCloseStatus.NormalClosure, "", stop.Token).ConfigureAwait(false);
            }
            catch (OperationCanceledException) { }
            catch (Exception error) {  // the receiver ends with it
                if (reason.Length == 0) reason = Explain(error);
                stop.Cancel();
            }
        }

        // False: this was all, and the client is disposed.
        async Task<bool> SendWhatThereIs() {
            for (;;) {
                DeviceSettings changes = TakeSetting();
                if (changes != null) await Send(Messages.Device(changes)).ConfigureAwait(false);
                ulong number;
                Draft draft = TakeDraft(out number);
                if (draft != null) await SendFrame(number, draft).ConfigureAwait(false);
                bool commanded = await SendCommands().ConfigureAwait(false);
                if (draft == null && changes == null && !commanded) lock (gate) return !disposed || !waiting.IsEmpty;
                await Task.Delay(TimeSpan.FromSeconds(1 / frameLimit_Hz), stop.Token).ConfigureAwait(false);
            }
        }

        // At most a few at once: the server limits the rate of messages. False: there was none.
        async Task<bool> SendCommands() {
            const int Most = 4;
            for (int sentNow = 0; sentNow < Most; ++sentNow) {
                byte[] command;
                lock (gate) command = commands.Count > 0 ? commands.Dequeue() : null;
                if (command == null) return sentNow > 0;
                await Send(command).ConfigureAwait(false);
            }
            return true;
        }

        async Task SendFrame(ulong number, Draft draft) {
            byte[] frame = draft.Frame(number);
            if (draft.HasBodies && !bodiesAsked) {
                bodiesAsked = true;
                await Send(Messages.Bodies(options)).ConfigureAwait(false);
            }
            if ((ulong)frame.Length <= messageLimit) {
                foreach (byte[] message in draft.Uploads()) await Send(message).ConfigureAwait(false);
                await Send(frame).ConfigureAwait(false);
                return;
            }
            Answered(number);
            string text = "the frame is larger than the " + messageLimit + " bytes of a message: " +
                "define its objects in several frames";
            Happened(new TouchEvent { Kind = TouchEventKind.Refused, Frame = number, Text = text });
        }

        DeviceSettings TakeSetting() {
            lock (gate) {
                DeviceSettings taken = setting;
                setting = null;
                return taken;
            }
        }

        // Null: nothing waits, or the server has enough to do.
        Draft TakeDraft(out ulong number) {
            lock (gate) {
                number = sent + 1;
                if (waiting.IsEmpty || sent - answered >= MaxUnanswered) return null;
                sent = number;
                Draft draft = waiting;
                waiting = new Draft();
                return draft;
            }
        }
    }

    static class Address {
        // ws://HOST:PORT/hl from any of the four forms; `token` from the query, if there is one.
        internal static Uri Parse(string url, ref string token) {
            Uri given;
            string scheme = Uri.TryCreate(url, UriKind.Absolute, out given) ? given.Scheme : "";
            bool own = scheme == "hl" || scheme == "hls";
            if ((!own && scheme != "ws" && scheme != "wss") || given.Host.Length == 0)
                throw new ArgumentException("'" + url + "' is no address of a server; they are hl://HOST[:PORT] " +
                    "and ws://HOST:PORT/hl");
            string query = given.Query;
            if (query.StartsWith("?token=")) token = Uri.UnescapeDataString(query.Substring("?token=".Length));
            else if (query.Length > 1) throw new ArgumentException("'" + query + "': the only option is ?token=TEXT");
            var address = new UriBuilder(given) { Query = "" };
            if (own) {
                address.Scheme = scheme == "hls" ? "wss" : "ws";
                address.Port = given.Port > 0 ? given.Port : 1997;
            }
            if (address.Path == "" || address.Path == "/") address.Path = "/hl";
            return address.Uri;
        }
    }

    // What the next frame changes. An object that is null is deleted.
    sealed class Draft {
        internal readonly Dictionary<uint, Content> Objects = new Dictionary<uint, Content>();
        internal readonly Dictionary<Tuple<uint, int>, double> Isos = new Dictionary<Tuple<uint, int>, double>();
        internal Content World;
        internal Vec3? Gravity;

        internal bool IsEmpty {
            get { return World == null && Objects.Count == 0 && Isos.Count == 0 && !Gravity.HasValue; }
        }
        internal bool HasBodies {
            get {
                foreach (Content content in Objects.Values) if (content != null && content.HasBody) return true;
                return false;
            }
        }

        // The object is another one now, or none.
        internal void ForgetIsos(uint id) {
            foreach (var iso in new List<Tuple<uint, int>>(Isos.Keys)) if (iso.Item1 == id) Isos.Remove(iso);
        }

        internal void Merge(Draft later) {
            foreach (var entry in later.Objects) {
                Objects[entry.Key] = entry.Value;
                ForgetIsos(entry.Key);
            }
            foreach (var entry in later.Isos) Isos[entry.Key] = entry.Value;
            World = later.World ?? World;
            Gravity = later.Gravity ?? Gravity;
        }

        internal IEnumerable<byte[]> Uploads() {
            foreach (Content content in Objects.Values)
                if (content != null) foreach (byte[] upload in content.Uploads) yield return upload;
            if (World != null) foreach (byte[] upload in World.Uploads) yield return upload;
        }

        internal byte[] Frame(ulong number) {
            var frame = new Writer().Number(1, number);
            foreach (var entry in Objects) {
                if (entry.Value == null) frame.Number(5, entry.Key);
                else frame.Nested(4, new Writer().Number(1, entry.Key).Append(entry.Value.Items));
            }
            if (World != null) frame.Nested(6, World.Items);
            foreach (var entry in Isos)
                frame.Nested(11, new Writer().Number(1, entry.Key.Item1).Number(2, (ulong)entry.Key.Item2)
                    .Double(3, entry.Value));
            frame.Vector(10, Gravity);
            return new Writer().Nested(3, frame).ToArray();
        }
    }

    // Items as they are sent, and the uploads that they refer to.
    sealed class Content {
        const int LargeShape_bytes = 1 << 14;  // goes as an upload, so that frames stay within the limit of a message
        const int NumbersPerPart = 1 << 17;   // at most 1 MiB: what is sent behind a part waits for it
        const int BytesPerPart = 1 << 20;

        internal readonly Writer Items = new Writer();
        internal readonly List<byte[]> Uploads = new List<byte[]>();
        internal bool HasBody;

        internal static Content Of(TouchItem[] items, int field, ref ulong nextUpload) {
            var content = new Content();
            foreach (TouchItem item in items) {
                int shapes = Count(item.Mesh, item.Heights, item.Volume, item.Cloud, item.Implicit);
                if (shapes + (item.Object == 0 ? 0 : 1) != 1)
                    throw new ArgumentException(
                        "an item has either a mesh, heights, a volume, a cloud, an implicit surface or the number of an object");
                content.Items.Nested(field, content.One(item, ref nextUpload));
            }
            return content;
        }

        Writer One(TouchItem item, ref ulong nextUpload) {
            var sent = new Writer();
            if (item.Object != 0) sent.Number(3, item.Object);
            else {
                var parts = new List<Writer>(PartsOf(item));
                var whole = new Writer();
                foreach (Writer part in parts) if (whole.Size < LargeShape_bytes) whole.Append(part);
                if (whole.Size < LargeShape_bytes) sent.Nested(1, whole);
                else {
                    sent.Number(2, nextUpload);
                    AddUploads(parts, nextUpload++);
                }
            }
            if (item.Matrix != null) {
                if (item.Matrix.Length != 16) throw new ArgumentException("a matrix has 16 numbers");
                sent.Doubles(4, item.Matrix, 0, 16);
            }
            if (item.Material != null) sent.Nested(5, Messages.Material(item.Material));
            if (item.Name.HasValue) sent.Number(6, item.Name.Value);
            return sent;
        }

        static int Length(Array list) { return list == null ? 0 : list.Length; }

        static int Count(params object[] choices) {
            int count = 0;
            foreach (object choice in choices) if (choice != null) ++count;
            return count;
        }

        void AddUploads(List<Writer> parts, ulong id) {
            foreach (Writer part in parts)
                Uploads.Add(new Writer().Nested(2, new Writer().Number(1, id).Nested(2, part)).ToArray());
        }

        static IEnumerable<Writer> PartsOf(TouchItem item) {
            if (item.Heights != null) return WithSamples(8, Messages.Heights(item.Heights), 5, item.Heights.Samples);
            if (item.Volume != null) return WithSamples(9, Messages.Volume(item.Volume), 7, item.Volume.Samples);
            if (item.Implicit != null) return new[] { new Writer().Nested(10, Messages.Implicit(item.Implicit)) };
            return item.Cloud != null ? Parts(item.Cloud) : Parts(item.Mesh);
        }

        // Field `field` of Primitives, whose field `list` has the samples.
        static IEnumerable<Writer> WithSamples(int field, Writer head, int list, Array samples) {
            yield return new Writer().Nested(field, head);
            int bytes = Buffer.ByteLength(samples);
            for (int first = 0; first < bytes; first += BytesPerPart)
                yield return new Writer().Nested(field, new Writer().Bytes(list, samples, first, BytesPerPart));
        }

        static IEnumerable<Writer> Parts(TouchCloud cloud) {
            if (Length(cloud.Points) == 0 || cloud.Points.Length % 3 != 0)
                throw new ArgumentException("a point of a cloud has three numbers");
            yield return new Writer().Nested(12, new Writer().Flag(5, cloud.Reach > 0).Double(6, cloud.Reach));
            for (int first = 0; first < cloud.Points.Length; first += NumbersPerPart)
                yield return new Writer().Nested(12, new Writer().Doubles(3, cloud.Points, first, NumbersPerPart));
            for (int first = 0; first < 4 * Length(cloud.Normals); first += BytesPerPart)
                yield return new Writer().Nested(12, new Writer().Bytes(4, cloud.Normals, first, BytesPerPart));
            int[] colours = cloud.Colours == null ? null : Array.ConvertAll(cloud.Colours, value => (int)value);
            for (int first = 0; first < Length(colours); first += NumbersPerPart)
                yield return new Writer().Nested(12, new Writer().Indices(7, colours, first, NumbersPerPart));
        }

        // Messages of Primitives, to be merged in this order: their lists are appended.
        static IEnumerable<Writer> Parts(TouchMesh mesh) {
            if (Length(mesh.Vertices) % 3 != 0) throw new ArgumentException("a vertex has three numbers");
            double[][] numbers = { mesh.Vertices, mesh.Normals, mesh.TexCoords };
            for (int field = 1; field <= 3; ++field)
                for (int first = 0; first < Length(numbers[field - 1]); first += NumbersPerPart)
                    yield return new Writer().Doubles(field, numbers[field - 1], first, NumbersPerPart);
            int[][] indices = { mesh.Triangles, mesh.Segments, mesh.Points };
            int[] fields = { 4, 6, 7 };
            for (int list = 0; list < 3; ++list)
                for (int first = 0; first < Length(indices[list]); first += NumbersPerPart)
                    yield return new Writer().Indices(fields[list], indices[list], first, NumbersPerPart);
        }
    }

    // Bodies of what the client sends; numbers of fields as in proto/hl.proto.
    static class Messages {
        internal static byte[] Open(ClientOptions options, string token) {
            var open = new Writer().Number(1, 1).Text(2, options.Name).Text(3, token).Number(4, options.Device)
                .Flag(5, options.Master).Flag(6, options.KeepObjects).Double(7, options.StateRate_Hz)
                .Text(20, options.DeviceLabel);
            return new Writer().Nested(1, open).ToArray();
        }

        internal static Writer Material(TouchMaterial material) {
            var sent = new Writer().Double(1, material.Stiffness).Double(2, material.StaticFriction)
                .Double(3, material.DynamicFriction).Double(4, material.Viscosity_Ns_m).Double(5, material.Stribeck_m_s)
                .Double(10, material.Presliding_N_m).Double(11, material.Adhesion_N)
                .Double(12, material.Compliance_m_N).Double(13, material.Strength_N);
            return material.Flat.HasValue ? sent.Flag(6, material.Flat.Value) : sent;
        }

        internal static byte[] Device(DeviceSettings changes) {
            var sent = new Writer().Double(1, changes.ProxyRadius).Double(3, changes.Stiffness_N_m);
            if (changes.WorkspaceOrigin.HasValue) {
                Writer origin = Vector(changes.WorkspaceOrigin.Value);
                sent.Nested(2, new Writer().Nested(1, origin).Double(2, changes.WorldPerDevice));
            }
            if (changes.Rearm) sent.Flag(5, true);
            if (changes.HandGoal.HasValue) sent.Nested(6, new Writer().Nested(1, Vector(changes.HandGoal.Value)));
            if (changes.HandTurn.HasValue || changes.HandGripper_rad.HasValue) {
                var turn = new Writer();
                if (changes.HandTurn.HasValue) turn.Nested(1, Turn(changes.HandTurn.Value));
                sent.Nested(8, turn.Double(2, changes.HandGripper_rad));
            }
            return new Writer().Nested(5, sent).ToArray();
        }

        internal static byte[] Bodies(ClientOptions options) {
            var asked = new Writer().Flag(1, true).Flag(2, options.BodyEvents).Double(3, options.ImpactsAbove_N_s);
            return new Writer().Nested(9, asked).ToArray();
        }

        internal static Writer Heights(TouchHeights heights) {
            string kind = KindOf(heights.Samples);
            if (heights.Columns < 2 || heights.Samples.Length % heights.Columns != 0)
                throw new ArgumentException("the samples must fill rows of so many columns");
            var sent = new Writer().Number(2, (ulong)heights.Columns)
                .Number(3, (ulong)(heights.Samples.Length / heights.Columns)).Text(6, kind).Double(7, heights.Missing)
                .Double(10, heights.VerticalScale);
            if (heights.Camera == null) return sent.Double(8, heights.Spacing);
            return sent.Doubles(11, heights.Camera).Double(12, heights.Join).Double(13, heights.Smoothing);
        }

        internal static Writer Volume(TouchVolume volume) {
            string kind = KindOf(volume.Samples);
            int slice = volume.Width * volume.Height;
            if (volume.Width < 2 || volume.Height < 2 || volume.Samples.Length % slice != 0)
                throw new ArgumentException("the samples must fill slices of Width x Height");
            int[] size = { volume.Width, volume.Height, volume.Samples.Length / slice };
            return new Writer().Double(3, volume.Iso).Flag(4, volume.Below).Indices(5, size, 0, 3).Text(8, kind)
                .Double(9, volume.Missing).Doubles(12, new[] { volume.Spacing });
        }

        internal static Writer Implicit(TouchImplicit surface) {
            if (surface.Solid == null) throw new ArgumentException("an implicit surface needs a solid");
            if (surface.Low.HasValue != surface.High.HasValue)
                throw new ArgumentException("the box where an implicit surface ends has two corners");
            var sent = new Writer().Nested(1, Expression(surface.Solid));
            if (surface.Low.HasValue) sent.Nested(2, new Writer().Vector(1, surface.Low).Vector(2, surface.High));
            return sent.Double(3, surface.Error);
        }

        internal static Writer Expression(Solid solid) {
            if (solid == null) throw new ArgumentException("a solid is made of solids that are there");
            return new Writer().Nested(solid.Kind, solid.Numbers).Vector(13, solid.Place).Vector(14, solid.Axis)
                .Double(15, solid.Degrees).Double(16, solid.Factor);
        }

        static string KindOf(Array samples) {
            if (samples is short[]) return "int16";
            if (samples is ushort[]) return "uint16";
            if (samples is float[]) return "float32";
            throw new ArgumentException("samples are short[], ushort[] or float[]");
        }

        // What an ObjectDefinition has beside its items.
        internal static Writer Extras(TouchObject defined) {
            var sent = new Writer();
            if (defined.Body != null) sent.Nested(3, Body(defined.Body));
            foreach (TouchSnap snap in defined.Snaps) sent.Nested(4, Snap(snap));
            foreach (TouchField field in defined.Fields) sent.Nested(5, Field(field));
            return sent;
        }

        static Writer Body(TouchBody body) {
            return new Writer().Flag(1, body.Fixed).Double(2, body.Mass_kg).Double(3, body.Density_kg_m3)
                .Number(4, (ulong)body.Shape).Double(5, body.StaticFriction).Double(6, body.DynamicFriction)
                .Double(7, body.Restitution).Vector(8, body.Velocity_m_s).Vector(9, body.Spin_rad_s);
        }

        static Writer Snap(TouchSnap snap) {
            return new Writer().Doubles(2, Places(snap.Points)).Vector(3, snap.Normal).Double(4, snap.Capture)
                .Double(5, snap.Release_N);
        }

        static Writer Field(TouchField field) {
            return new Writer().Number(2, (ulong)field.Kind).Doubles(3, Places(field.Points)).Vector(4, field.Normal)
                .Double(5, field.Reach).Double(6, field.Force_N).Double(7, field.Stiffness_N_m)
                .Double(8, field.Damping_Ns_m).Vector(9, field.Direction);
        }

        static double[] Places(double[] points) {
            if (points == null || points.Length == 0 || points.Length % 3 != 0)
                throw new ArgumentException("a snap or field has points of three numbers each");
            return points;
        }

        // A WorldJoint.
        internal static Writer Joint(TouchJoint joint) {
            var sent = new Writer().Number(2, (ulong)joint.Kind).Vector(5, joint.Anchor)
                .Vector(6, joint.Kind == JointKind.Distance ? (Vec3?)joint.AnchorB : null).Vector(7, joint.Axis).Double(8, joint.Low).Double(9, joint.High).Double(10, joint.Rest)
                .Double(11, joint.Spring).Double(12, joint.Damping).Double(13, joint.Friction).Flag(15, joint.Collide);
            if (joint.TablePositions != null || joint.TableForces != null) sent.Nested(14, Table(joint));
            var all = new Writer().Number(1, joint.Id).Nested(2, sent).Nested(3, Called(joint.ObjectA, joint.NameA));
            return joint.ObjectB == 0 ? all : all.Nested(4, Called(joint.ObjectB, joint.NameB));
        }

        static Writer Table(TouchJoint joint) {
            if (joint.TablePositions?.Length != joint.TableForces?.Length)
                throw new ArgumentException("a joint's table has a force for each position");
            return new Writer().Doubles(1, joint.TablePositions).Doubles(2, joint.TableForces);
        }

        static Writer Called(uint body, uint? name) {
            var called = new Writer().Number(1, body);
            return name.HasValue ? called.Number(2, name.Value) : called;
        }

        internal static Writer Turn(Rotation r) {
            return new Writer().Double(1, r.X).Double(2, r.Y).Double(3, r.Z).Double(4, r.W);
        }

        internal static Writer Vector(Vec3 v) { return new Writer().Double(1, v.X).Double(2, v.Y).Double(3, v.Z); }
    }

    // What the server sends, read.
    static class Replies {
        internal static TouchState State(Reader from) {
            var state = new TouchState();
            var touched = new List<Touched>();
            var bodies = new List<BodyState>();
            var joints = new List<JointState>();
            var remote = new List<RemoteHand>();
            while (from.Next()) {
                switch (from.Field) {
                    case 1: state.Time_s = from.Double(); break;
                    case 2: state.Finger = Vector(from.Nested()); break;
                    case 3: state.Proxy = Vector(from.Nested()); break;
                    case 4: state.Force_N = Vector(from.Nested()); break;
                    case 5: touched.Add(TouchedObject(from.Nested())); break;
                    case 6: state.Safety = (Safety)from.Number; break;
                    case 7: state.Fault = from.Text(); break;
                    case 11: state.Buttons = (uint)from.Number; break;
                    case 12: state.ProxyRadius = from.Double(); break;
                    case 14: state.Master = from.Number != 0; break;
                    case 21: bodies.Add(Body(from.Nested())); break;
                    case 22: joints.Add(Joint(from.Nested())); break;
                    case 23: state.Snap = Snap(from.Nested()); break;
                    case 24: state.Stylus = Stylus(from.Nested()); break;
                    case 25: remote.Add(Remote(from.Nested())); break;
                }
            }
            state.Touched = touched.ToArray();
            state.Bodies = bodies.ToArray();
            state.Joints = joints.ToArray();
            state.RemoteHands = remote.ToArray();
            return state;
        }

        static RemoteHand Remote(Reader from) {
            var hand = new RemoteHand { Server = "", Device = "" };
            while (from.Next()) {
                switch (from.Field) {
                    case 1: hand.Device = from.Text(); break;
                    case 2: hand.Finger = Vector(from.Nested()); break;
                    case 3: hand.Proxy = Vector(from.Nested()); break;
                    case 4: hand.Force_N = Vector(from.Nested()); break;
                    case 7: hand.Buttons = (uint)from.Number; break;
                    case 8: hand.Contacts = (uint)from.Number; break;
                    case 11: hand.ProxyRadius = from.Double(); break;
                    case 12: hand.Stylus = Stylus(from.Nested()); break;
                    case 13: hand.Server = from.Text(); break;
                }
            }
            return hand;
        }

        static Touched TouchedObject(Reader from) {
            var touched = new Touched();
            while (from.Next()) {
                if (from.Field == 1) touched.Object = (uint)from.Number;
                if (from.Field == 2) touched.Name = (uint)from.Number;
                if (from.Field == 3) touched.Session = (uint)from.Number;
                if (from.Field != 4) continue;
                Reader plane = from.Nested();
                while (plane.Next()) {
                    if (plane.Field == 1) touched.Point = Vector(plane.Nested());
                    if (plane.Field == 2) touched.Normal = Vector(plane.Nested());
                }
            }
            return touched;
        }

        static Stylus Stylus(Reader from) {
            var stylus = new Stylus { Turned = new Rotation(0, 0, 0, 1) };
            while (from.Next()) {
                switch (from.Field) {
                    case 1: stylus.Turned = Turn(from.Nested()); break;
                    case 2: stylus.Spin_rad_s = Vector(from.Nested()); break;
                    case 3: stylus.Gripper_rad = from.Double(); break;
                    case 4: stylus.Gripper_N = from.Double(); break;
                }
            }
            return stylus;
        }

        static BodyState Body(Reader from) {
            var body = new BodyState { Rotation = new Rotation() };
            while (from.Next()) {
                switch (from.Field) {
                    case 1: body.Object = (uint)from.Number; break;
                    case 2: body.Name = (uint)from.Number; break;
                    case 3: body.Position = Vector(from.Nested()); break;
                    case 4: body.Rotation = Turn(from.Nested()); break;
                    case 5: body.Velocity_m_s = Vector(from.Nested()); break;
                    case 6: body.Spin_rad_s = Vector(from.Nested()); break;
                }
            }
            return body;
        }

        static JointState Joint(Reader from) {
            var joint = new JointState();
            while (from.Next()) {
                switch (from.Field) {
                    case 1: joint.Id = (uint)from.Number; break;
                    case 2: joint.Coordinate = from.Double(); break;
                    case 3: joint.Velocity = from.Double(); break;
                    case 4: joint.Force = from.Double(); break;
                    case 5: joint.Held_N = Vector(from.Nested()); break;
                }
            }
            return joint;
        }

        static HoldingSnap Snap(Reader from) {
            var snap = new HoldingSnap();
            while (from.Next()) {
                if (from.Field == 1) snap.Object = (uint)from.Number;
                if (from.Field == 2) snap.Name = (uint)from.Number;
                if (from.Field == 3) snap.Session = (uint)from.Number;
                if (from.Field == 4) snap.Number = (uint)from.Number;
            }
            return snap;
        }

        static Rotation Turn(Reader from) {
            var turn = new Rotation();
            while (from.Next()) {
                if (from.Field == 1) turn.X = from.Double();
                if (from.Field == 2) turn.Y = from.Double();
                if (from.Field == 3) turn.Z = from.Double();
                if (from.Field == 4) turn.W = from.Double();
            }
            return turn;
        }

        // By the number on the wire; null: a motion.
        static readonly TouchEventKind?[] Kinds = { TouchEventKind.Touch, TouchEventKind.Untouch,
            TouchEventKind.Button, null, TouchEventKind.Sleep, TouchEventKind.Wake, TouchEventKind.Impact };

        // Null: a motion, or a kind of event that this client does not know.
        internal static TouchEvent Event(Reader from) {
            var happened = new TouchEvent();
            ulong kind = 0;
            while (from.Next()) {
                switch (from.Field) {
                    case 1: kind = from.Number; break;
                    case 2: happened.Time_s = from.Double(); break;
                    case 3: happened.Object = (uint)from.Number; break;
                    case 4: happened.Name = (uint)from.Number; break;
                    case 5: happened.Position = Vector(from.Nested()); break;
                    case 6: happened.Button = (uint)from.Number; break;
                    case 7: happened.Down = from.Number != 0; break;
                    case 8: happened.Impulse_N_s = from.Double(); break;
                }
            }
            if (kind >= (ulong)Kinds.Length || !Kinds[kind].HasValue) return null;
            happened.Kind = Kinds[kind].Value;
            return happened;
        }

        static Vec3 Vector(Reader from) {
            var v = new Vec3();
            while (from.Next()) {
                if (from.Field == 1) v.X = from.Double();
                if (from.Field == 2) v.Y = from.Double();
                if (from.Field == 3) v.Z = from.Double();
            }
            return v;
        }
    }

    // Writes fields of protobuf's binary form; each call returns the writer.
    sealed class Writer {
        byte[] bytes = new byte[64];
        int size;

        internal byte[] ToArray() {
            var all = new byte[size];
            Buffer.BlockCopy(bytes, 0, all, 0, size);
            return all;
        }

        void Reserve(int more) {
            if (size + more > bytes.Length) Array.Resize(ref bytes, Math.Max(2 * bytes.Length, size + more));
        }

        void Varint(ulong value) {
            Reserve(10);
            for (; value >= 0x80; value >>= 7) bytes[size++] = (byte)(value | 0x80);
            bytes[size++] = (byte)value;
        }

        void Raw(double value) {
            Reserve(8);
            long bits = BitConverter.DoubleToInt64Bits(value);
            for (int shift = 0; shift < 64; shift += 8) bytes[size++] = (byte)(bits >> shift);
        }

        void Raw(byte[] from, int count) {
            Reserve(count);
            Buffer.BlockCopy(from, 0, bytes, size, count);
            size += count;
        }

        // Wire types: 0 a varint, 1 eight bytes, 2 a length and so many bytes.
        void Key(int field, int wireType) { Varint((ulong)(field << 3 | wireType)); }

        internal Writer Number(int field, ulong value) { Key(field, 0); Varint(value); return this; }
        internal Writer Flag(int field, bool value) { return Number(field, value ? 1UL : 0UL); }

        internal Writer Double(int field, double? value) {
            if (!value.HasValue) return this;
            Key(field, 1);
            Raw(value.Value);
            return this;
        }

        internal Writer Text(int field, string text) {
            byte[] utf8 = Encoding.UTF8.GetBytes(text ?? "");
            Key(field, 2);
            Varint((ulong)utf8.Length);
            Raw(utf8, utf8.Length);
            return this;
        }

        // At most `most` bytes of an array of numbers, from byte `first` on; little-endian, as all machines of .NET.
        internal Writer Bytes(int field, Array numbers, int first, int most) {
            int count = Math.Min(most, Buffer.ByteLength(numbers) - first);
            Key(field, 2);
            Varint((ulong)count);
            Reserve(count);
            Buffer.BlockCopy(numbers, first, bytes, size, count);
            size += count;
            return this;
        }

        internal int Size { get { return size; } }
        internal Writer Append(Writer other) { Raw(other.bytes, other.size); return this; }

        internal Writer Nested(int field, Writer message) {
            Key(field, 2);
            Varint((ulong)message.size);
            return Append(message);
        }

        internal Writer Vector(int field, Vec3? v) { return v.HasValue ? Nested(field, Messages.Vector(v.Value)) : this; }
        internal Writer Doubles(int field, double[] values) { return Doubles(field, values, 0, values.Length); }

        // At most `most` numbers from number `first` on.
        internal Writer Doubles(int field, double[] values, int first, int most) {
            int count = Math.Min(most, values.Length - first);
            Key(field, 2);
            Varint(8 * (ulong)count);
            Reserve(8 * count);
            for (int i = first; i < first + count; ++i) Raw(values[i]);
            return this;
        }

        internal Writer Indices(int field, int[] values, int first, int most) {
            var packed = new Writer();
            int count = Math.Min(most, values.Length - first);
            for (int i = first; i < first + count; ++i) packed.Varint((uint)values[i]);
            return Nested(field, packed);
        }
    }

    // Goes through the fields of one message.
    struct Reader {
        readonly byte[] bytes;
        readonly int end;
        int at, begin, length;
        internal int Field;
        internal ulong Number;  // of the field; or its length

        internal Reader(byte[] bytes, int begin, int count) : this() {
            this.bytes = bytes;
            at = begin;
            end = begin + count;
        }

        internal bool Next() {
            if (at >= end) return false;
            ulong key = Varint();
            Field = (int)(key >> 3);
            int wireType = (int)(key & 7);
            if (wireType == 0) Number = Varint();
            else if (wireType == 1) Number = Fixed(8);
            else if (wireType == 5) Number = Fixed(4);
            else if (wireType == 2) Skip(Varint());
            else throw new FormatException("a reply is no message of HL");
            return true;
        }

        internal double Double() { return BitConverter.Int64BitsToDouble((long)Number); }
        internal Reader Nested() { return new Reader(bytes, begin, length); }
        internal string Text() { return Encoding.UTF8.GetString(bytes, begin, length); }

        void Skip(ulong count) {
            if (count > (ulong)(end - at)) throw new FormatException("a reply is cut");
            begin = at;
            length = (int)count;
            at += length;
        }

        ulong Fixed(int count) {
            Skip((ulong)count);
            ulong value = 0;
            for (int i = count - 1; i >= 0; --i) value = value << 8 | bytes[begin + i];
            return value;
        }

        ulong Varint() {
            ulong value = 0;
            for (int shift = 0; shift < 64; shift += 7) {
                if (at >= end) throw new FormatException("a reply is cut");
                byte part = bytes[at++];
                value |= (ulong)(part & 0x7f) << shift;
                if (part < 0x80) return value;
            }
            throw new FormatException("a reply is no message of HL");
        }
    }
}
